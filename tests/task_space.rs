//! Goals for the end effector, and free final time.

mod problems;
mod trees;

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::dynamics::Placement;
use ffsm_ipopt::nalgebra::{Matrix3, Rotation3, Vector3};
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::planner::{EndEffectorGoal, GoalFrame, Plan, Problem, Status, plan};

/// The smooth two-link case with an end effector at the forearm's end.
fn two_link() -> Problem {
    let mut problem = problems::smooth();
    let tip = Placement::from_xyz_rpy([0.35 + 0.156, 0.0, 0.0], [0.0; 3]);
    problem.robot = problem.robot.with_end_effector(Some(1), tip);
    problem
}

/// Where the two-link arm's end effector is at t_f: inertial position from the system's mass
/// centre, and heading.
fn tip(plan: &Plan) -> ([f64; 2], f64) {
    let last = |rows: &[Vec<f64>]| rows.last().unwrap().clone();
    let eta = last(&plan.trajectory.base_attitude)[0];
    let base = last(&plan.trajectory.base_position);
    let joints = last(&plan.trajectory.joint_position);
    let headings = [eta, eta + joints[0], eta + joints[0] + joints[1]];
    let lengths = [0.156, 0.506, 0.506];
    let along = |f: fn(f64) -> f64| {
        headings
            .iter()
            .zip(lengths)
            .map(|(h, l)| l * f(*h))
            .sum::<f64>()
    };
    (
        [base[0] + along(f64::cos), base[1] + along(f64::sin)],
        headings[2],
    )
}

#[test]
fn a_point_reached_by_the_joint_goal_costs_no_more_as_a_point() {
    let by_joints = plan(&two_link()).unwrap();
    let (point, _) = tip(&by_joints);
    let mut problem = two_link();
    problem.task.free_joints = vec![true; 2];
    problem.task.end_effector = Some(EndEffectorGoal::at(GoalFrame::Inertial, &point));
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
    let mut problem = two_link();
    problem.task.free_joints = vec![true; 2];
    problem.task.end_effector = Some(EndEffectorGoal::at(GoalFrame::Start, &seen));
    let by_point = plan(&problem).unwrap();
    let (reached, _) = tip(&by_point);
    assert!((reached[0] - point[0]).hypot(reached[1] - point[1]) < 1e-7);
}

#[test]
fn a_heading_with_a_tolerance_is_met_at_its_near_edge() {
    let mut problem = two_link();
    problem.task.final_joints = vec![0.0, 0.3];
    problem.task.free_joints = vec![false, true];
    problem.task.end_effector = Some(EndEffectorGoal {
        frame: GoalFrame::Base,
        position: None,
        position_tolerance: 0.0,
        orientation: Some(vec![1.0]),
        orientation_tolerance: 0.1,
    });
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Solved);
    let joints = plan.trajectory.joint_position.last().unwrap();
    // Joint 1 is held: the heading in the base frame is joint 2's angle, and less motion is
    // cheaper.
    assert!((joints[1] - 0.9).abs() < 1e-6, "{joints:?}");
}

#[test]
fn a_point_out_of_reach_is_named() {
    let mut problem = two_link();
    problem.task.free_joints = vec![true; 2];
    problem.task.end_effector = Some(EndEffectorGoal::at(GoalFrame::Base, &[2.0, 0.5]));
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Infeasible);
    let limits = plan.diagnosis.unwrap().limits;
    assert!(
        limits.iter().any(|l| l.key == "task.final.end_effector"),
        "{limits:?}"
    );
}

#[test]
fn a_pose_in_space_is_reached() {
    let mut problem = Problem::new("pose", trees::chain(6, 9), 10.0, &[0.0; 6], &[0.0; 6]);
    let mount = Placement::from_xyz_rpy([0.2, 0.1, 0.3], [0.3, -0.5, 1.0]);
    problem.robot = problem.robot.with_end_effector(Some(5), mount.clone());
    problem.cost.joint_rate = vec![1.0; 6];
    problem.cost.base_rate = vec![1.0; 3];
    problem.cost.control = vec![0.1; 6];
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
    let mut task = problem.clone();
    task.task.free_joints = vec![true; 6];
    task.task.end_effector = Some(EndEffectorGoal {
        frame: GoalFrame::Base,
        position: Some(position.iter().copied().collect()),
        position_tolerance: 0.0,
        orientation: Some(vec![roll, pitch, yaw]),
        orientation_tolerance: 0.0,
    });
    let plan = plan(&task).unwrap();
    assert_eq!(plan.status, Status::Solved);
    let (turned, reached) = pose(plan.trajectory.joint_position.last().unwrap());
    assert!((reached - position).norm() < 1e-7);
    assert!((turned - rotation).norm() < 1e-7);
}

#[test]
fn the_fastest_motion_is_as_fast_as_the_slowest_joint() {
    let mut problem = problems::relaxed();
    problem.task.duration = Interval::new(0.5, 20.0);
    problem.cost.duration = 100.0;
    problem.limits.base_rate = vec![Interval::FREE];
    problem.mesh.max_iterations = 1;
    problem.mesh.segments = 20;
    let plan = plan(&problem).unwrap();
    // Joint 2: 60° at up to 0.9 rad/s, sped up and slowed down at 4 rad/s², but for the Coriolis
    // term that stands between control and acceleration.
    let alone = std::f64::consts::FRAC_PI_3 / 0.9 + 0.9 / 4.0;
    let duration = plan.discretization.duration;
    assert!(
        (duration - alone).abs() < 0.05 * alone,
        "{duration} s against {alone} s"
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
        (plan.objective - 0.466819).abs() < 5e-6,
        "J = {}",
        plan.objective
    );
    let degrees = plan.metrics.final_base_attitude.to_degrees();
    assert!(
        (degrees - 0.530).abs() < 2e-3,
        "final base attitude {degrees}°"
    );
}
