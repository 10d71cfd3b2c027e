//! Robots in space.

use crate::checks::*;
use crate::problem_kinds::*;
use crate::problems;
use crate::trees;
use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::ocp::{Elastic, Interval, LimitGroup};
use ffsm_ipopt::problem::GoalFrame;
use ffsm_ipopt::system::FreeFloating;

#[test]
fn a_system_that_drifts_and_tumbles() {
    for robot in [problems::two_link(), trees::chain(3, 6)] {
        let mut problem = with_goal(loaded(robot), GoalFrame::Inertial).into_builder();
        let momentum = &mut problem.task.initial_momentum;
        momentum
            .linear
            .iter_mut()
            .enumerate()
            .for_each(|(i, p)| *p = 0.4 - 0.3 * i as f64);
        momentum
            .angular
            .iter_mut()
            .enumerate()
            .for_each(|(i, l)| *l = 0.2 + 0.1 * i as f64);
        check_problem(&problem.build().unwrap(), Mesh::uniform(1, 2).unwrap());
    }
}

#[test]
fn three_joints_in_space() {
    check_problem(&loaded(trees::chain(3, 3)), small());
}

#[test]
fn a_tree_with_a_sliding_joint() {
    let kinds = [
        trees::REVOLUTE,
        trees::PRISMATIC,
        trees::REVOLUTE,
        trees::PRISMATIC,
    ];
    let rng = &mut fastrand::Rng::with_seed(11);
    let robot = trees::random(rng, &[None, Some(0), Some(0), None], &kinds);
    check_problem(&loaded(robot), Mesh::uniform(1, 2).unwrap());
}

#[test]
fn seven_joints_in_space() {
    check_problem(&loaded(trees::chain(7, 5)), Mesh::uniform(1, 2).unwrap());
}

#[test]
fn attitude_by_quaternion_and_by_rodrigues_parameters() {
    for attitude in [SpatialAttitude::Quaternion, SpatialAttitude::Mrp] {
        let arm = described(loaded(trees::chain(3, 4)), attitude);
        check_problem(&arm, Mesh::uniform(1, 2).unwrap());
        let tumbling = with_goal(arm, GoalFrame::Start)
            .edited(|tumbling| {
                tumbling.task.initial_momentum.angular = vec![0.2, -0.3, 0.4];
                tumbling.limits.final_base_attitude = vec![Interval::symmetric(1.2)];
            })
            .unwrap();
        check_problem(&tumbling, Mesh::uniform(1, 2).unwrap());
        // The limits on the rotation angle give way as one.
        let system = FreeFloating::spatial(&tumbling);
        let groups = groups(&system);
        let turn = |g: &&LimitGroup| g.name == "base rotation angle";
        let turn: Vec<_> = groups.iter().filter(turn).cloned().collect();
        assert_eq!((turn.len(), turn[0].members.len()), (1, 3), "{turn:?}");
        check(
            &Elastic::new(&system, turn, 1e-3),
            Mesh::uniform(1, 1).unwrap(),
        );
    }
}
