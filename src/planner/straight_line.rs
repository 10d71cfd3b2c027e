//! Base motion when the joints move along the straight line from start to goal.

use super::{FreeFloating, Problem};
use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};

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
    match FreeFloating::planar(problem) {
        Some(planar) => integrate(problem, &planar),
        None => integrate(problem, &FreeFloating::spatial(problem)),
    }
}

/// Steps of the classical Runge-Kutta method; its error is far below what is shown.
const STEPS: usize = 500;

fn integrate<Sp: Space>(problem: &Problem, system: &FreeFloating<Sp>) -> StraightLine {
    let (tree, attitude) = (system.tree(), system.attitude());
    let (from, to) = (&problem.task.initial_joints, &problem.task.final_joints);
    let span: Vec<f64> = from.iter().zip(to).map(|(a, b)| b - a).collect();
    let mut data = Data::<Sp, f64>::new(tree);
    let mut rates = |part: f64, eta: &[f64]| -> Vec<f64> {
        let q: Vec<f64> = from.iter().zip(&span).map(|(a, d)| a + part * d).collect();
        tree.kinematics(&q, &mut data);
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
    let h = 1.0 / STEPS as f64;
    for step in 0..STEPS {
        let s = step as f64 * h;
        let k1 = rates(s, &eta);
        let k2 = rates(s + 0.5 * h, &moved(&eta, &k1, 0.5 * h));
        let k3 = rates(s + 0.5 * h, &moved(&eta, &k2, 0.5 * h));
        let k4 = rates(s + h, &moved(&eta, &k3, h));
        for i in 0..eta.len() {
            eta[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
        }
    }
    let position = |q: &[f64], eta: &[f64]| -> Vec<f64> {
        let mut data = Data::<Sp, f64>::new(tree);
        tree.kinematics(q, &mut data);
        tree.momentum(&mut data);
        attitude
            .base_position(eta, &data.system_center)
            .components()
            .to_vec()
    };
    let start = position(from, attitude.start());
    let end = position(to, &eta);
    StraightLine {
        base_displacement: end.iter().zip(&start).map(|(a, b)| a - b).collect(),
        base_attitude: eta,
    }
}
