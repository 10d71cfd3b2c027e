//! A base that starts turned moves as one that does not.

use crate::trees;
use crate::two_link::*;
use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::nalgebra::{Rotation2, Rotation3, Vector2, Vector3};
use ffsm_ipopt::planner::{Plan, Status, plan};
use ffsm_ipopt::problem::{EndEffectorGoal, GoalFrame, Problem};
use ffsm_ipopt::system::{StraightLine, straight_line};

#[test]
fn a_base_that_starts_turned_moves_as_one_that_does_not() {
    let turn: f64 = 0.7;
    // A pose that the arm can reach, seen from the start.
    let by_joints = plan(&two_link()).unwrap();
    let (point, heading) = tip(&by_joints);
    let start = &by_joints.trajectory.base_position[0];
    let seen = vec![point[0] - start[0], point[1] - start[1]];
    let problem = |turned: f64| {
        let problem = two_link().edited(|problem| {
            // What is counted from the inertial axes would tell them apart.
            problem.cost.final_base_attitude = vec![0.0];
            problem.task.free_joints = vec![true; 2];
            problem.task.initial_base_attitude = vec![turned];
            problem.task.end_effector = Some(EndEffectorGoal {
                frame: GoalFrame::Start,
                position: Some(seen.clone()),
                position_tolerance: 0.01,
                orientation: Some(vec![heading]),
                orientation_tolerance: 0.2,
            });
        });
        problem.unwrap()
    };
    let [straight, turned] = [0.0, turn].map(|turned| plan(&problem(turned)).unwrap());
    assert_eq!(
        (straight.status, turned.status),
        (Status::Solved, Status::Solved)
    );
    assert!((straight.objective - turned.objective).abs() < 1e-8 * straight.objective);
    let ends = |plan: &Plan| {
        let motion = &plan.trajectory;
        let last = motion.t.len() - 1;
        let base = &motion.base_position;
        (
            motion.base_attitude[last][0],
            Vector2::new(base[last][0] - base[0][0], base[last][1] - base[0][1]),
            motion.joint_position[last].clone(),
        )
    };
    let (before, after) = (ends(&straight), ends(&turned));
    assert_eq!(turned.trajectory.base_attitude[0], [turn]);
    assert!(
        (after.0 - before.0 - turn).abs() < 1e-6,
        "{} {}",
        after.0,
        before.0
    );
    let expected = Rotation2::new(turn) * before.1;
    assert!((after.1 - expected).norm() < 1e-7, "{} {expected}", after.1);
    for (a, b) in after.2.iter().zip(&before.2) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
    let (a, b) = (&straight.goals[0], &turned.goals[0]);
    assert!((a.distance.unwrap() - b.distance.unwrap()).abs() < 1e-7);
    assert!((a.angle.unwrap() - b.angle.unwrap()).abs() < 1e-7);
}

#[test]
fn a_base_in_space_that_starts_turned() {
    let angles = [0.4, -0.9, 2.0];
    let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]);
    let of = |attitude, turned: [f64; 3]| {
        let mut problem =
            Problem::builder("turned", trees::chain(4, 9), 10.0, &[0.0; 4], &[0.7; 4]);
        problem.set_attitude(attitude);
        problem.task.initial_base_attitude = turned.to_vec();
        straight_line(&problem.build().unwrap())
    };
    for attitude in SpatialAttitude::ALL {
        let (before, after) = (of(attitude, [0.0; 3]), of(attitude, angles));
        let rotation = |found: &StraightLine| attitude.to_quaternion(&found.base_attitude);
        let expected = turn * rotation(&before).to_rotation_matrix();
        let found = rotation(&after).to_rotation_matrix();
        assert!(
            (found.matrix() - expected.matrix()).amax() < 1e-8,
            "{attitude:?}"
        );
        let moved = |found: &StraightLine| Vector3::from_column_slice(&found.base_displacement);
        assert!(
            (moved(&after) - turn * moved(&before)).amax() < 1e-10,
            "{attitude:?}"
        );
    }
}
