//! Starting trajectories: joints through way-points, the base following by momentum.

use super::{FreeFloating, Problem};
use crate::collocation::Mesh;
use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::refine::Start;
use crate::transcription::Discretization;

/// Steps of the base's integration along the whole motion.
const STEPS: usize = 400;

/// A joint path from rest to rest through way-points, one quintic a leg, the time shared out by
/// each leg's length.
#[derive(Debug, Clone)]
pub(super) struct JointPath {
    points: Vec<Vec<f64>>,
    /// Fraction of the duration at which each point is reached.
    at: Vec<f64>,
}

impl JointPath {
    pub fn new(problem: &Problem, way_points: Vec<Vec<f64>>) -> Self {
        let mut points = vec![problem.task.initial_joints.clone()];
        points.extend(way_points);
        points.push(problem.task.final_joints.clone());
        let mut at = vec![0.0];
        for pair in points.windows(2) {
            let leg = pair[0]
                .iter()
                .zip(&pair[1])
                .map(|(a, b)| (b - a).abs())
                .fold(0.0, f64::max);
            at.push(at[at.len() - 1] + leg.max(1e-6));
        }
        let total = at[at.len() - 1];
        at.iter_mut().for_each(|t| *t /= total);
        Self { points, at }
    }

    /// Positions, and first and second derivatives by the fraction of the duration.
    fn at_fraction(&self, fraction: f64, q: &mut [f64], dq: &mut [f64], ddq: &mut [f64]) {
        let leg = self
            .at
            .partition_point(|&t| t <= fraction)
            .clamp(1, self.at.len() - 1)
            - 1;
        let width = self.at[leg + 1] - self.at[leg];
        let p = (fraction - self.at[leg]) / width;
        let blend = p * p * p * (10.0 + p * (6.0 * p - 15.0));
        let slope = 30.0 * p * p * (1.0 - p) * (1.0 - p) / width;
        let bend = 60.0 * p * (1.0 - p) * (1.0 - 2.0 * p) / (width * width);
        for (i, (a, b)) in self.points[leg]
            .iter()
            .zip(&self.points[leg + 1])
            .enumerate()
        {
            q[i] = a + blend * (b - a);
            dq[i] = slope * (b - a);
            ddq[i] = bend * (b - a);
        }
    }
}

/// The joint path on `mesh`, with the base attitude that momentum conservation gives.
pub(super) fn along<Sp: Space>(
    problem: &FreeFloating<Sp>,
    duration: f64,
    path: &JointPath,
    mesh: Mesh,
) -> Discretization {
    let (n, angles) = (problem.joint_count(), problem.attitude().count());
    let attitude = follow(problem, duration, path);
    let (mut q, mut dq, mut ddq) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    Discretization::sample(mesh, duration, angles + 2 * n, n, |fraction, x, u| {
        path.at_fraction(fraction, &mut q, &mut dq, &mut ddq);
        let position = fraction * STEPS as f64;
        let (k, share) = (position as usize, position.fract());
        let (a, b) = (&attitude[k.min(STEPS)], &attitude[(k + 1).min(STEPS)]);
        for i in 0..angles {
            x[i] = a[i] + share * (b[i] - a[i]);
        }
        for j in 0..n {
            x[angles + j] = q[j];
            x[angles + n + j] = dq[j] / duration;
            u[j] = ddq[j] / (duration * duration);
        }
    })
}

/// A start whose joints go from rest to rest through `way_points` (each of length n), the base
/// following by momentum.
pub fn through<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    way_points: Vec<Vec<f64>>,
    mesh: Mesh,
) -> Start {
    let path = JointPath::new(problem, way_points);
    let duration = problem.task.duration.center();
    Start {
        trajectory: along(system, duration, &path, mesh),
        iterate: None,
    }
}

/// Base attitude on an even grid along the path, by the midpoint rule.
fn follow<Sp: Space>(problem: &FreeFloating<Sp>, duration: f64, path: &JointPath) -> Vec<Vec<f64>> {
    let n = problem.joint_count();
    let (tree, parameters) = (problem.tree(), problem.attitude());
    let mut data = Data::<Sp, f64>::new(tree);
    let (mut q, mut dq, mut ddq) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let mut rates = vec![0.0; parameters.count()];
    let mut attitude = vec![parameters.start().to_vec()];
    for k in 0..STEPS {
        path.at_fraction((k as f64 + 0.5) / STEPS as f64, &mut q, &mut dq, &mut ddq);
        tree.kinematics(&q, &mut data);
        tree.momentum(&mut data);
        dq.iter_mut().for_each(|rate| *rate /= duration);
        let eta = &attitude[k];
        let mut turn = |at: &[f64]| -> Vec<f64> {
            problem.base_rate(at, &dq, &mut data);
            parameters.rates(at, &data.base_rate, &mut rates);
            rates
                .iter()
                .map(|rate| rate * duration / STEPS as f64)
                .collect()
        };
        let half = turn(eta);
        let middle: Vec<f64> = eta.iter().zip(&half).map(|(a, r)| a + 0.5 * r).collect();
        let next = eta.iter().zip(turn(&middle)).map(|(a, r)| a + r).collect();
        attitude.push(next);
    }
    attitude
}
