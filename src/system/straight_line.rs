//! Base motion when the joints move along the straight line from start to goal.

use super::dispatch::{System, with_system};
use super::free_floating::FreeFloating;
use super::motion::Trajectory;
use super::quintic::quintic;
use super::tumble;
use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::integrate::Rk4;
use crate::problem::Problem;

/// Where the base ends after the straight joint path: what planning has to beat.
///
/// The path is passed from rest to rest with quintic timing. Without momentum the base's motion is
/// the same whatever the timing, since momentum is linear in the rates; with momentum the duration
/// counts, the middle of its range where it is free.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct StraightLine {
    /// Base attitude at the end: angles in rad, or the parameters of another description.
    pub base_attitude: Vec<f64>,
    /// Base displacement from its start, inertial axes, m.
    pub base_displacement: Vec<f64>,
}

/// Base motion along the straight joint path of `problem`'s task.
pub fn straight_line(problem: &Problem) -> StraightLine {
    let path = straight_motion(problem, problem.task.duration.center(), STEPS);
    let [start, end] = [0, STEPS].map(|k| &path.base_position[k]);
    StraightLine {
        base_displacement: end.iter().zip(start).map(|(a, b)| a - b).collect(),
        base_attitude: path.base_attitude[STEPS].clone(),
    }
}

/// The straight joint path of `problem`'s task in `duration` seconds from rest to rest, with quintic
/// timing, at `steps` + 1 even times: times, joint positions and base poses of a [`Trajectory`],
/// whose other columns stay empty.
pub fn straight_motion(problem: &Problem, duration: f64, steps: usize) -> Trajectory {
    if let Some(other) = tumble::by_quaternion(problem) {
        let mut motion = straight_motion(&other, duration, steps);
        tumble::describe(problem.attitude, &mut motion);
        return motion;
    }
    with_system!(&System::new(problem), system => {
        integrate(problem, system, duration, steps.max(1))
    })
}

/// Steps of the classical Runge-Kutta method; its error is far below what is shown.
const STEPS: usize = 1000;

fn integrate<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    duration: f64,
    steps: usize,
) -> Trajectory {
    let (tree, attitude) = (system.tree(), system.attitude());
    let (from, to) = (&problem.task.initial_joints, &problem.task.final_joints);
    let joints = |t: f64, q: &mut [f64], dq: &mut [f64]| {
        let [share, rate, _] = quintic(t, duration);
        for (j, (a, b)) in from.iter().zip(to).enumerate() {
            q[j] = a + share * (b - a);
            dq[j] = rate * (b - a);
        }
    };
    let mut data = Data::<Sp, f64>::new(tree);
    let (mut q, mut dq) = (vec![0.0; from.len()], vec![0.0; from.len()]);
    let mut eta = system.start_attitude().to_vec();
    let mut method = Rk4::new(eta.len());
    let mut path = Trajectory {
        attitude: attitude.in_space(),
        ..Trajectory::default()
    };
    let h = duration / steps as f64;
    let within = STEPS.div_ceil(steps).max(tumble::steps(system, h));
    for k in 0..=steps {
        let t = k as f64 * h;
        joints(t, &mut q, &mut dq);
        tree.kinematics(&q, &mut data);
        tree.momentum(&mut data);
        let position = system.base_position(&eta, t, &data);
        path.t.push(t);
        path.base_position.push(position.components().to_vec());
        path.base_attitude.push(eta.clone());
        path.joint_position.push(q.clone());
        if k == steps {
            break;
        }
        let rate = |t: f64, eta: &[f64], rates: &mut [f64]| {
            joints(t, &mut q, &mut dq);
            tree.kinematics(&q, &mut data);
            tree.momentum(&mut data);
            system.base_rate(eta, &dq, &mut data);
            attitude.rates(eta, &data.base_rate, rates);
        };
        let before = eta.clone();
        method.integrate(rate, [t, t + h], within, &mut eta);
        tumble::settle::<Sp>(attitude, &before, &mut eta);
    }
    path
}
