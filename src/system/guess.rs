//! Starting trajectories: joints through way-points, the base following by momentum.

use super::free_floating::FreeFloating;
use super::quintic::quintic;
use super::tumble;
use crate::collocation::Mesh;
use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::problem::{Problem, Task};
use crate::refine::Start;
use crate::transcription::Discretization;
use std::f64::consts::TAU;

/// Steps of the base's integration along the whole motion.
const STEPS: usize = 400;

/// A joint path from rest to rest, one quintic a leg, without acceleration where two meet.
#[derive(Debug, Clone)]
pub(crate) struct JointPath {
    knots: Vec<Knot>,
    on_top: Option<Loop>,
}

/// A loop of two joints on a part of a path, from rest to rest: an ellipse that begins and ends where
/// the path is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Loop {
    pub joints: [usize; 2],
    /// Half axes, rad or m.
    pub radii: [f64; 2],
    /// Where on the ellipse it begins, rad.
    pub phase: f64,
    /// How often it goes round; negative the other way.
    pub turns: f64,
    /// Fractions of the duration between which it goes.
    pub from: f64,
    pub to: f64,
}

impl Loop {
    /// Adds what it moves the joints at a fraction of the duration, with derivatives by it.
    pub fn add_at(&self, fraction: f64, q: &mut [f64], dq: &mut [f64], ddq: &mut [f64]) {
        if fraction <= self.from || fraction >= self.to {
            return;
        }
        let round = self.turns * TAU;
        let along = quintic(fraction - self.from, self.to - self.from);
        let [s, ds, dds] = along.map(|share| round * share);
        let begins = self.phase.sin_cos();
        let (sin, cos) = (self.phase + s).sin_cos();
        let [i, j] = self.joints;
        let [a, b] = self.radii;
        q[i] += a * (cos - begins.1);
        q[j] += b * (sin - begins.0);
        dq[i] -= a * sin * ds;
        dq[j] += b * cos * ds;
        ddq[i] -= a * (cos * ds * ds + sin * dds);
        ddq[j] += b * (cos * dds - sin * ds * ds);
    }
}

#[derive(Debug, Clone)]
struct Knot {
    /// Fraction of the duration.
    at: f64,
    q: Vec<f64>,
    /// Derivative by the fraction of the duration.
    dq: Vec<f64>,
}

impl JointPath {
    /// Through the way-points of `problem`'s task, and through `detours` between them: as many on
    /// each leg, at rest, the leg's time shared out by the distances.
    pub fn new(problem: &Problem, detours: &[Vec<f64>]) -> Self {
        Self::of(&problem.task, detours)
    }

    /// The same of a task alone.
    pub fn of(task: &Task, detours: &[Vec<f64>]) -> Self {
        let passed = passed(task);
        let legs = passed.len() - 1;
        let mut knots = Vec::new();
        for (leg, ends) in passed.windows(2).enumerate() {
            let share = |leg: usize| detours.len() * leg / legs;
            knots.push(ends[0].clone());
            knots.extend(between(ends, &detours[share(leg)..share(leg + 1)]));
        }
        knots.extend(passed.into_iter().next_back());
        Self {
            knots,
            on_top: None,
        }
    }

    /// The same with `on_top` added.
    pub fn with_loop(self, on_top: Loop) -> Self {
        Self {
            on_top: Some(on_top),
            ..self
        }
    }

    /// Fractions of the duration at which the leg around `fraction` begins and ends.
    pub fn leg_at(&self, fraction: f64) -> (f64, f64) {
        let leg = self.leg(fraction);
        (self.knots[leg].at, self.knots[leg + 1].at)
    }

    /// The leg around a fraction of the duration.
    fn leg(&self, fraction: f64) -> usize {
        let before = self.knots.partition_point(|knot| knot.at <= fraction);
        before.clamp(1, self.knots.len() - 1) - 1
    }

    /// Positions, and first and second derivatives by the fraction of the duration.
    pub fn at_fraction(&self, fraction: f64, q: &mut [f64], dq: &mut [f64], ddq: &mut [f64]) {
        let knots = &self.knots;
        let leg = self.leg(fraction);
        let (a, b) = (&knots[leg], &knots[leg + 1]);
        let width = b.at - a.at;
        let p = (fraction - a.at) / width;
        for i in 0..q.len() {
            let start = a.dq[i] * width;
            // What the end is off the straight line, in position and rate.
            let (off, rate) = (b.q[i] - a.q[i] - start, b.dq[i] * width - start);
            let [c3, c4, c5] = [
                10.0 * off - 4.0 * rate,
                7.0 * rate - 15.0 * off,
                6.0 * off - 3.0 * rate,
            ];
            q[i] = a.q[i] + p * (start + p * p * (c3 + p * (c4 + p * c5)));
            dq[i] = (start + p * p * (3.0 * c3 + p * (4.0 * c4 + p * 5.0 * c5))) / width;
            ddq[i] = p * (6.0 * c3 + p * (12.0 * c4 + p * 20.0 * c5)) / (width * width);
        }
        if let Some(on_top) = self.on_top {
            on_top.add_at(fraction, q, dq, ddq);
        }
    }
}

/// Start, way-points and goal. Joints that have no position at a way-point are on the way from
/// the one before to the one after; rates that are not given are those of the chord around it,
/// or none where the joint turns back.
fn passed(task: &Task) -> Vec<Knot> {
    let n = task.initial_joints.len();
    let points = &task.way_points;
    let mut at = vec![0.0];
    at.extend(points.iter().map(|p| p.fraction(&task.duration)));
    at.push(1.0);
    let mut knots: Vec<Knot> = at
        .iter()
        .map(|&at| Knot {
            at,
            q: vec![0.0; n],
            dq: vec![0.0; n],
        })
        .collect();
    let last = knots.len() - 1;
    for j in 0..n {
        let known: Vec<Option<f64>> = std::iter::once(Some(task.initial_joints[j]))
            .chain(points.iter().map(|point| {
                let guessed = || point.guess.as_ref().map(|guess| guess[j]);
                point.joints[j].or_else(guessed)
            }))
            .chain([Some(task.final_joints[j])])
            .collect();
        let mut before = (0.0, task.initial_joints[j]);
        for k in 0..=last {
            let after = (k..=last).find_map(|i| Some((at[i], known[i]?)));
            let (t, q) = after.unwrap_or(before);
            let share = if t > before.0 {
                (at[k] - before.0) / (t - before.0)
            } else {
                1.0
            };
            knots[k].q[j] = before.1 + share * (q - before.1);
            if known[k].is_some() {
                before = (at[k], knots[k].q[j]);
            }
        }
        for k in 1..last {
            let slope = |a: usize, b: usize| (knots[b].q[j] - knots[a].q[j]) / (at[b] - at[a]);
            let passing = if slope(k - 1, k) * slope(k, k + 1) > 0.0 {
                slope(k - 1, k + 1)
            } else {
                0.0
            };
            let given = points[k - 1].joint_rates[j];
            let scale = task.duration.center();
            knots[k].dq[j] = given.map_or(passing, |rate| rate * scale);
        }
    }
    knots
}

/// Knots at rest on the leg between `ends`.
fn between(ends: &[Knot], detours: &[Vec<f64>]) -> Vec<Knot> {
    let (start, end) = (&ends[0], &ends[1]);
    let points: Vec<&Vec<f64>> = std::iter::once(&start.q)
        .chain(detours)
        .chain([&end.q])
        .collect();
    let mut lengths = vec![0.0];
    for pair in points.windows(2) {
        let gap = pair[0].iter().zip(pair[1]).map(|(a, b)| (b - a).abs());
        lengths.push(lengths[lengths.len() - 1] + gap.fold(0.0, f64::max).max(1e-6));
    }
    let total = lengths[lengths.len() - 1];
    detours
        .iter()
        .zip(&lengths[1..])
        .map(|(q, length)| Knot {
            at: start.at + (end.at - start.at) * length / total,
            q: q.clone(),
            dq: vec![0.0; q.len()],
        })
        .collect()
}

/// The joint path on `mesh`, with the base attitude that momentum conservation gives.
pub(crate) fn along<Sp: Space>(
    problem: &FreeFloating<Sp>,
    duration: f64,
    path: &JointPath,
    mesh: Mesh,
) -> Discretization {
    let (n, angles) = (problem.joint_count(), problem.attitude().count());
    let attitude = follow(problem, duration, path);
    let (mut q, mut dq, mut ddq) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let sampled = Discretization::sample(mesh, duration, angles + 2 * n, n, |fraction, x, u| {
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
    });
    problem.with_peaks(sampled)
}

/// A start whose joints go from rest to rest through `way_points` (each of length n) as well, the base
/// following by momentum.
pub fn through<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    way_points: Vec<Vec<f64>>,
    mesh: Mesh,
) -> Start {
    let path = JointPath::new(problem, &way_points);
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
    let within = tumble::steps(problem, duration / STEPS as f64);
    let all = within * STEPS;
    let mut eta = problem.start_attitude().to_vec();
    let mut attitude = vec![eta.clone()];
    for k in 0..all {
        path.at_fraction((k as f64 + 0.5) / all as f64, &mut q, &mut dq, &mut ddq);
        tree.kinematics(&q, &mut data);
        tree.momentum(&mut data);
        dq.iter_mut().for_each(|rate| *rate /= duration);
        let mut turn = |at: &[f64]| -> Vec<f64> {
            problem.base_rate(at, &dq, &mut data);
            parameters.rates(at, &data.base_rate, &mut rates);
            let turns = rates.iter().map(|rate| rate * duration / all as f64);
            turns.collect()
        };
        let half = turn(&eta);
        let middle: Vec<f64> = eta.iter().zip(&half).map(|(a, r)| a + 0.5 * r).collect();
        let mut next: Vec<f64> = eta.iter().zip(turn(&middle)).map(|(a, r)| a + r).collect();
        tumble::settle::<Sp>(parameters, &eta, &mut next);
        eta = next;
        if (k + 1) % within == 0 {
            attitude.push(eta.clone());
        }
    }
    attitude
}
