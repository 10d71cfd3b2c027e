//! What first derivatives leave to second ones.

use crate::problem_kinds::loaded;
use crate::problems;
use crate::trees;
use ffsm_ipopt::dynamics::Model;
use ffsm_ipopt::nalgebra::Vector3;
use ffsm_ipopt::ocp::{Interval, Ocp, Point};
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::system::FreeFloating;

fn kinds() -> Vec<Model> {
    let rng = &mut fastrand::Rng::with_seed(5);
    let mut robots = trees::zoo(9);
    robots.push(problems::two_link());
    robots.push(trees::planar(rng, Vector3::new(0.3, -0.5, 0.8)));
    robots.push(trees::chain(10, 2));
    robots
}

/// A Hessian from what another evaluator, which has gone on since, has kept of its Jacobian is that
/// of an evaluator without a past, to the bit; at another point what was kept is of no effect.
fn check<O: Ocp>(ocp: &O) {
    let formulation = ocp.formulation();
    let (states, controls) = formulation.widths();
    let parameters = formulation.parameters.len();
    let inputs = states + controls + parameters + 1;
    let outputs = states + formulation.path.len() + 1 + formulation.integrals.len();
    let mut random = fastrand::Rng::with_seed(11);
    let mut draw = |count: usize| -> Vec<f64> {
        let one = |_| 2.0 * random.f64() - 1.0;
        (0..count).map(one).collect()
    };
    let points: Vec<Vec<f64>> = (0..2).map(|_| draw(inputs)).collect();
    let weights = draw(outputs);
    let point = |k: usize| {
        let (x, rest) = points[k].split_at(states);
        let (u, rest) = rest.split_at(controls);
        Point {
            x,
            u,
            parameters: &rest[..parameters],
            t: rest[parameters],
        }
    };
    let evaluator = || ocp.derivatives().expect("derivatives of its own");
    let mut first = evaluator();
    let mut jacobian = vec![0.0; outputs * inputs];
    let mut kept = vec![0.0; first.kept()];
    assert!(!kept.is_empty(), "nothing is kept");
    let mut second = evaluator();
    second.recall(&kept);
    first.jacobian(point(0), &mut jacobian);
    first.keep(&mut kept);
    first.jacobian(point(1), &mut jacobian);
    for k in [0, 1] {
        let [mut found, mut expected] = [(); 2].map(|()| vec![0.0; inputs * inputs]);
        second.recall(&kept);
        second.hessian(point(k), &weights, &mut found);
        evaluator().hessian(point(k), &weights, &mut expected);
        assert_eq!(bits(&found), bits(&expected), "point {k}");
    }
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn what_is_kept_changes_no_bit() {
    for robot in kinds() {
        for momentum in [0.0, 0.3] {
            let mut problem = loaded(robot.clone()).into_builder();
            let n = robot.joint_count();
            let (angles, _) = Problem::base_sizes(&robot);
            problem.limits.torque = vec![Interval::symmetric(3.0); n];
            problem.task.initial_momentum.angular = vec![momentum; angles];
            let problem = problem.build().expect("a valid problem");
            match FreeFloating::planar(&problem) {
                Some(system) => check(&system),
                None => check(&FreeFloating::spatial(&problem)),
            }
        }
    }
}
