//! Way-points.

use crate::trees;
use crate::two_link::*;
use ffsm_ipopt::dynamics::Placement;
use ffsm_ipopt::nalgebra::{Matrix3, Rotation3, Vector3};
use ffsm_ipopt::planner::{Plan, Planner, Status, plan};
use ffsm_ipopt::problem::{EndEffectorGoal, GoalFrame, Moment, Problem, WayPoint};

/// States of `plan` at the node that stands at `fraction` of the duration.
fn passed(plan: &Plan, fraction: f64) -> &[f64] {
    let node = plan.discretization.mesh.node_at(fraction);
    plan.discretization
        .state(node.expect("a node at the way-point"))
}

#[test]
fn a_way_point_is_passed_at_its_time() {
    let problem = two_link();
    let direct = plan(&problem).unwrap();
    // Back and forth: 0.8 and −0.4 after 7 s, at rest; then joint 2 alone through 0.9.
    let mut stop = WayPoint::joints(Moment::Time(7.0), &[0.8, -0.4]);
    stop.joint_rates = vec![Some(0.0); 2];
    let mut half = WayPoint::joints(Moment::Fraction(0.61), &[0.0, 0.9]);
    half.joints[0] = None;
    let problem = problem
        .edited(|problem| problem.task.way_points = vec![stop, half])
        .unwrap();
    let through = plan(&problem).unwrap();
    assert_eq!(through.status, Status::Solved);
    assert!(through.trajectory.t.contains(&7.0));
    let x = passed(&through, 0.35);
    for (value, expected) in x[1..].iter().zip([0.8, -0.4, 0.0, 0.0]) {
        assert!((value - expected).abs() < 1e-9, "{x:?}");
    }
    let x = passed(&through, 0.61);
    assert!((x[2] - 0.9).abs() < 1e-9, "{x:?}");
    // What is free there is used: the arm does not stop.
    assert!(x[3].abs() > 1e-3 && x[4].abs() > 1e-3, "{x:?}");
    assert!(through.objective > direct.objective + 1e-2);
    for record in &through.iterations {
        assert!(record.breakpoints.contains(&0.35) && record.breakpoints.contains(&0.61));
    }
}

#[test]
fn a_way_point_on_the_best_path_costs_nothing() {
    let problem = two_link()
        .edited(|problem| problem.mesh.tolerance = 1e-7)
        .unwrap();
    let direct = plan(&problem).unwrap();
    let node = direct.discretization.mesh.points() / 3;
    let fraction = direct.discretization.mesh.node_fractions()[node];
    let joints = &direct.discretization.state(node)[1..3];
    let problem = problem
        .edited(|problem| {
            problem.task.way_points = vec![WayPoint::joints(Moment::Fraction(fraction), joints)]
        })
        .unwrap();
    let through = plan(&problem).unwrap();
    assert_eq!(through.status, Status::Solved);
    let gap = (through.objective - direct.objective).abs();
    assert!(gap < 1e-8, "{} and {}", through.objective, direct.objective);
}

#[test]
fn one_planner_serves_problems_with_and_without_way_points() {
    let mut planner = Planner::new();
    let mut problem = two_link()
        .edited(|problem| {
            problem.mesh.max_iterations = Some(1);
            problem.mesh.tolerance = 1.0;
        })
        .unwrap();
    let mut point = WayPoint::joints(Moment::Fraction(0.4), &[0.4, 0.2]);
    let mut objectives = Vec::new();
    for end_effector in [
        None,
        Some(EndEffectorGoal::at(GoalFrame::Start, &[1.0, 0.3])),
    ] {
        objectives.push(planner.plan(&problem).unwrap().objective);
        point.end_effector = end_effector;
        point.joints = vec![None, Some(0.2)];
        problem = problem
            .edited(|problem| problem.task.way_points = vec![point.clone()])
            .unwrap();
    }
    let last = planner.plan(&problem).unwrap();
    assert_eq!(last.status, Status::Solved);
    objectives.push(last.objective);
    assert!(
        objectives[0] < objectives[1] && objectives[1] < objectives[2],
        "{objectives:?}"
    );
}

#[test]
fn a_pose_in_space_is_passed_on_the_way() {
    let n = 6;
    let mut problem = Problem::builder("pose", trees::chain(n, 9), 10.0, &[0.0; 6], &[0.1; 6]);
    let mount = Placement::from_xyz_rpy([0.2, 0.1, 0.3], [0.3, -0.5, 1.0]);
    problem.robot = problem.robot.with_end_effector(Some(n - 1), mount.clone());
    problem.cost.joint_rate = vec![1.0; n];
    problem.cost.base_rate = vec![1.0; 3];
    problem.cost.control = vec![0.1; n];
    let problem = problem.build().unwrap();
    // The base's own pose at 40 % of the way there and back again.
    let robot = problem.robot.clone();
    let pose = |x: &[f64], base: &[f64], start: &[f64]| -> (Matrix3<f64>, Vector3<f64>) {
        let mut rotation = Rotation3::from_euler_angles(x[0], x[1], x[2]).into_inner();
        let mut origin = Vector3::from_fn(|i, _| base[i] - start[i]);
        for (joint, angle) in robot.joints().iter().zip(&x[3..]) {
            origin += rotation * joint.placement.translation;
            let turn = Rotation3::from_axis_angle(&joint.axis, *angle);
            rotation = rotation * joint.placement.rotation * turn.matrix();
        }
        (
            rotation * mount.rotation,
            origin + rotation * mount.translation,
        )
    };
    let at = |plan: &Plan, fraction: f64| {
        let node = plan.discretization.mesh.node_at(fraction).unwrap();
        let base = &plan.trajectory.base_position;
        pose(plan.discretization.state(node), &base[node], &base[0])
    };
    // A pose that joints can reach there, a way off the direct path.
    let by_joints = WayPoint::joints(Moment::Fraction(0.4), &[0.4, -0.3, 0.5, 0.2, -0.4, 0.3]);
    let joints = problem
        .edited(|joints| joints.task.way_points = vec![by_joints])
        .unwrap();
    let joints = plan(&joints).unwrap();
    assert_eq!(joints.status, Status::Solved);
    let (rotation, position) = at(&joints, 0.4);
    let (roll, pitch, yaw) = Rotation3::from_matrix_unchecked(rotation).euler_angles();
    let goal = |position_tolerance, orientation_tolerance| EndEffectorGoal {
        frame: GoalFrame::Start,
        position: Some(position.iter().copied().collect()),
        position_tolerance,
        orientation: Some(vec![roll, pitch, yaw]),
        orientation_tolerance,
    };
    let problem = problem
        .edited(|problem| {
            problem.task.way_points = vec![WayPoint::pose(Moment::Time(4.0), n, goal(0.0, 0.0))]
        })
        .unwrap();
    let exact = plan(&problem).unwrap();
    assert_eq!(exact.status, Status::Solved);
    let (turned, reached) = at(&exact, 0.4);
    assert!((reached - position).norm() < 1e-7);
    assert!((turned - rotation).norm() < 1e-7);
    // The pose leaves joints to the planner, a tolerance leaves more.
    assert!(exact.objective <= joints.objective * (1.0 + 1e-6));
    let problem = problem
        .edited(|problem| {
            problem.task.way_points = vec![WayPoint::pose(Moment::Time(4.0), n, goal(0.02, 0.1))]
        })
        .unwrap();
    let near = plan(&problem).unwrap();
    assert_eq!(near.status, Status::Solved);
    assert!(near.objective < 0.99 * exact.objective);
    let [found] = &near.goals[..] else {
        panic!("{:?}", near.goals);
    };
    assert_eq!(found.key, "task.way_points[0].end_effector");
    assert_eq!(found.t, 4.0);
    let (turned, reached) = at(&near, 0.4);
    assert!((found.distance.unwrap() - (reached - position).norm()).abs() < 1e-9);
    let angle = Rotation3::from_matrix_unchecked(rotation.transpose() * turned).angle();
    assert!((found.angle.unwrap() - angle).abs() < 1e-7);
    // It is used to the full along some axis.
    assert!((reached - position).amax() > 0.02 - 1e-6);
}

#[test]
fn a_way_point_that_cannot_be_reached_in_time_is_named() {
    let problem = two_link()
        .edited(|problem| {
            // 1 rad in 0.4 s at 0.9 rad/s.
            problem.task.way_points = vec![WayPoint::joints(Moment::Time(0.4), &[1.0, 0.0])];
        })
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Infeasible);
    let limits = plan.diagnosis.unwrap().limits;
    let named = limits
        .iter()
        .find(|l| l.limit.key() == "task.way_points[0]");
    let named = named.unwrap_or_else(|| panic!("{limits:?}"));
    assert_eq!(named.unit.symbol(), "rad");
    assert!(
        named.name.starts_with("position of joint joint1"),
        "{named:?}"
    );
}
