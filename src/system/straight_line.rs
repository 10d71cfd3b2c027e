//! Base motion when the joints move along the straight line from start to goal.

use super::dispatch::{System, with_system};
use super::free_floating::FreeFloating;
use super::motion::Trajectory;
use super::quintic::quintic;
use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::problem::Problem;

/// Where the base ends after the straight joint path: what planning has to beat.
///
/// Independent of the speed along the path, since momentum is linear in the rates.
#[derive(Debug, Clone, PartialEq)]
pub struct StraightLine {
    /// Base attitude at the end: angles in rad, or the parameters of another description.
    pub base_attitude: Vec<f64>,
    /// Base displacement from its start, inertial axes, m.
    pub base_displacement: Vec<f64>,
}

/// Base motion along the straight joint path of `problem`'s task.
pub fn straight_line(problem: &Problem) -> StraightLine {
    let parts: Vec<f64> = (0..=STEPS).map(|k| k as f64 / STEPS as f64).collect();
    let path = with_system!(&System::new(problem), system => integrate(problem, system, &parts));
    let ends = |rows: &[Vec<f64>]| [rows[0].clone(), rows[STEPS].clone()];
    let [start, end] = ends(&path.base_position);
    let [_, base_attitude] = ends(&path.base_attitude);
    StraightLine {
        base_displacement: end.iter().zip(&start).map(|(a, b)| a - b).collect(),
        base_attitude,
    }
}

/// The straight joint path of `problem`'s task in `duration` seconds from rest to rest, with quintic
/// timing, at `steps` + 1 even times: times, joint positions and base poses of a [`Trajectory`],
/// whose other columns stay empty.
pub fn straight_motion(problem: &Problem, duration: f64, steps: usize) -> Trajectory {
    let times = (0..=steps).map(|k| duration * k as f64 / steps.max(1) as f64);
    let t: Vec<f64> = times.collect();
    let parts: Vec<f64> = t.iter().map(|&t| quintic(t, duration)[0]).collect();
    let path = with_system!(&System::new(problem), system => integrate(problem, system, &parts));
    Trajectory { t, ..path }
}

/// Steps of the classical Runge-Kutta method; its error is far below what is shown.
const STEPS: usize = 500;

/// Base poses and joint positions at the shares `parts` of the path, one step between each two.
fn integrate<Sp: Space>(problem: &Problem, system: &FreeFloating<Sp>, parts: &[f64]) -> Trajectory {
    let (tree, attitude) = (system.tree(), system.attitude());
    let (from, to) = (&problem.task.initial_joints, &problem.task.final_joints);
    let span: Vec<f64> = from.iter().zip(to).map(|(a, b)| b - a).collect();
    let joints =
        |part: f64| -> Vec<f64> { from.iter().zip(&span).map(|(a, d)| a + part * d).collect() };
    let mut data = Data::<Sp, f64>::new(tree);
    let mut rates = |part: f64, eta: &[f64]| -> Vec<f64> {
        tree.kinematics(&joints(part), &mut data);
        tree.momentum(&mut data);
        tree.base_rate(&span, &mut data);
        let mut rates = vec![0.0; attitude.count()];
        attitude.rates(eta, &data.base_rate, &mut rates);
        rates
    };
    let moved = |eta: &[f64], k: &[f64], h: f64| -> Vec<f64> {
        eta.iter().zip(k).map(|(a, b)| a + h * b).collect()
    };
    let mut eta = attitude.start().to_vec();
    let mut path = Trajectory {
        attitude: attitude.in_space(),
        ..Trajectory::default()
    };
    let mut reached = Data::<Sp, f64>::new(tree);
    let mut record = |part: f64, eta: &[f64]| {
        let q = joints(part);
        tree.kinematics(&q, &mut reached);
        tree.momentum(&mut reached);
        let position = attitude.base_position(eta, &reached.system_center);
        path.base_position.push(position.components().to_vec());
        path.base_attitude.push(eta.to_vec());
        path.joint_position.push(q);
    };
    if let Some(&first) = parts.first() {
        record(first, &eta);
    }
    for step in parts.windows(2) {
        let (s, h) = (step[0], step[1] - step[0]);
        let k1 = rates(s, &eta);
        let k2 = rates(s + 0.5 * h, &moved(&eta, &k1, 0.5 * h));
        let k3 = rates(s + 0.5 * h, &moved(&eta, &k2, 0.5 * h));
        let k4 = rates(s + h, &moved(&eta, &k3, h));
        for i in 0..eta.len() {
            eta[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
        }
        record(step[1], &eta);
    }
    path
}
