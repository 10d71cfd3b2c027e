//! Goals for the end effector.

use crate::trees;
use crate::two_link::*;
use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::dynamics::Placement;
use ffsm_ipopt::nalgebra::{Matrix3, Rotation3, Vector3};
use ffsm_ipopt::planner::{Status, plan};
use ffsm_ipopt::problem::{EndEffectorGoal, GoalFrame, Problem};

#[test]
fn a_point_reached_by_the_joint_goal_costs_no_more_as_a_point() {
    let by_joints = plan(&two_link()).unwrap();
    let (point, _) = tip(&by_joints);
    let problem = two_link()
        .edited(|problem| {
            problem.task.free_joints = vec![true; 2];
            problem.task.end_effector = Some(EndEffectorGoal::at(GoalFrame::Inertial, &point));
        })
        .unwrap();
    let by_point = plan(&problem).unwrap();
    assert_eq!(by_point.status, Status::Solved);
    let (reached, _) = tip(&by_point);
    assert!((reached[0] - point[0]).hypot(reached[1] - point[1]) < 1e-7);
    assert!(
        by_point.objective <= by_joints.objective + 1e-8,
        "{} against {}",
        by_point.objective,
        by_joints.objective
    );
}

#[test]
fn a_point_seen_from_the_start_is_the_same_point() {
    let by_joints = plan(&two_link()).unwrap();
    let (point, _) = tip(&by_joints);
    let start = &by_joints.trajectory.base_position[0];
    let seen = [point[0] - start[0], point[1] - start[1]];
    let problem = two_link()
        .edited(|problem| {
            problem.task.free_joints = vec![true; 2];
            problem.task.end_effector = Some(EndEffectorGoal::at(GoalFrame::Start, &seen));
        })
        .unwrap();
    let by_point = plan(&problem).unwrap();
    let (reached, _) = tip(&by_point);
    assert!((reached[0] - point[0]).hypot(reached[1] - point[1]) < 1e-7);
}

#[test]
fn a_heading_with_a_tolerance_is_met_at_its_near_edge() {
    let problem = two_link()
        .edited(|problem| {
            problem.task.final_joints = vec![0.0, 0.3];
            problem.task.free_joints = vec![false, true];
            problem.task.end_effector = Some(EndEffectorGoal {
                frame: GoalFrame::Base,
                position: None,
                position_tolerance: 0.0,
                orientation: Some(vec![1.0]),
                orientation_tolerance: 0.1,
            });
        })
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Solved);
    let joints = plan.trajectory.joint_position.last().unwrap();
    // Joint 1 is held: the heading in the base frame is joint 2's angle, and less motion is
    // cheaper.
    assert!((joints[1] - 0.9).abs() < 1e-6, "{joints:?}");
}

#[test]
fn a_point_out_of_reach_is_named() {
    let problem = two_link()
        .edited(|problem| {
            problem.task.free_joints = vec![true; 2];
            problem.task.end_effector = Some(EndEffectorGoal::at(GoalFrame::Base, &[2.0, 0.5]));
        })
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Infeasible);
    let limits = plan.diagnosis.unwrap().limits;
    assert!(
        limits
            .iter()
            .any(|l| l.limit.key() == "task.final.end_effector"),
        "{limits:?}"
    );
}

#[test]
fn a_pose_in_space_is_reached() {
    let mut problem = Problem::builder("pose", trees::chain(6, 9), 10.0, &[0.0; 6], &[0.0; 6]);
    let mount = Placement::from_xyz_rpy([0.2, 0.1, 0.3], [0.3, -0.5, 1.0]);
    problem.robot = problem.robot.with_end_effector(Some(5), mount.clone());
    problem.cost.joint_rate = vec![1.0; 6];
    problem.cost.base_rate = vec![1.0; 3];
    problem.cost.control = vec![0.1; 6];
    let problem = problem.build().unwrap();
    let wanted: [f64; 6] = [0.4, -0.3, 0.5, 0.2, -0.4, 0.3];
    let pose = |q: &[f64]| -> (Matrix3<f64>, Vector3<f64>) {
        let mut rotation = Matrix3::identity();
        let mut origin = Vector3::zeros();
        for (joint, angle) in problem.robot.joints().iter().zip(q) {
            origin += rotation * joint.placement.translation;
            let turn = Rotation3::from_axis_angle(&joint.axis, *angle);
            rotation = rotation * joint.placement.rotation * turn.matrix();
        }
        (
            rotation * mount.rotation,
            origin + rotation * mount.translation,
        )
    };
    let (rotation, position) = pose(&wanted);
    let (roll, pitch, yaw) = Rotation3::from_matrix_unchecked(rotation).euler_angles();
    let task = problem
        .edited(|task| {
            task.task.free_joints = vec![true; 6];
            task.task.end_effector = Some(EndEffectorGoal {
                frame: GoalFrame::Base,
                position: Some(position.iter().copied().collect()),
                position_tolerance: 0.0,
                orientation: Some(vec![roll, pitch, yaw]),
                orientation_tolerance: 0.0,
            });
        })
        .unwrap();
    let plan = plan(&task).unwrap();
    assert_eq!(plan.status, Status::Solved);
    let (turned, reached) = pose(plan.trajectory.joint_position.last().unwrap());
    assert!((reached - position).norm() < 1e-7);
    assert!((turned - rotation).norm() < 1e-7);
    // The joints that reach it are one way to do so.
    let by_joints = problem
        .edited(|by_joints| by_joints.task.final_joints = wanted.to_vec())
        .unwrap();
    let by_joints = self::plan(&by_joints).unwrap();
    assert_eq!(by_joints.status, Status::Solved);
    assert!(
        plan.objective <= by_joints.objective + 1e-8,
        "{} against {}",
        plan.objective,
        by_joints.objective
    );
}

#[test]
fn the_capture_case_meets_its_known_answer() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/config/capture.toml");
    let problem = ProblemFile::load(file.as_ref(), &Overrides::default())
        .unwrap()
        .problem;
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Solved);
    assert!(
        (plan.objective - 0.297674).abs() < 5e-6,
        "J = {}",
        plan.objective
    );
    let degrees = plan.metrics.final_base_attitude.to_degrees();
    assert!(
        (degrees - 0.211).abs() < 2e-3,
        "final base attitude {degrees}°"
    );
}
