//! Changes to problems.

use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::dynamics::{Model, Placement};
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::problem::{EndEffectorGoal, GoalFrame, Problem};

/// Every weight and every limit at work.
pub fn loaded(robot: Model) -> Problem {
    let n = robot.joint_count();
    let (angles, lengths) = Problem::base_sizes(&robot);
    let mut problem = Problem::builder("loaded", robot, 3.0, &vec![0.1; n], &vec![0.5; n]);
    problem.cost.final_base_attitude = vec![1.3; angles];
    problem.cost.final_base_position = vec![0.8; lengths];
    problem.cost.base_attitude = (0..angles).map(|i| 0.9 - 0.2 * i as f64).collect();
    problem.cost.base_position = vec![0.7; lengths];
    problem.cost.base_rate = vec![0.6; angles];
    problem.cost.joint_rate = vec![0.2; n];
    problem.cost.control = vec![0.1; n];
    problem.limits.base_rate = vec![Interval::symmetric(0.6); angles];
    problem.limits.base_position = vec![Interval::new(-0.3, 0.2); lengths];
    problem.build().unwrap()
}

/// The same with the attitude described by `attitude`, its limits at work too.
pub fn described(problem: Problem, attitude: SpatialAttitude) -> Problem {
    let mut problem = problem.into_builder();
    problem.set_attitude(attitude);
    problem.cost.final_base_attitude = vec![1.3];
    problem.cost.base_attitude = vec![0.9];
    problem.cost.base_rate = vec![0.6, 0.5, 0.4];
    problem.limits.base_rate = vec![Interval::symmetric(0.6); 3];
    problem.limits.base_attitude = vec![Interval::symmetric(0.9)];
    problem.limits.final_base_attitude = vec![Interval::symmetric(0.4)];
    problem.build().unwrap()
}

pub fn with_goal(problem: Problem, frame: GoalFrame) -> Problem {
    let last = problem.robot.joint_count() - 1;
    let mount = Placement::from_xyz_rpy([0.3, 0.1, -0.2], [0.4, -0.3, 0.8]);
    let mut problem = problem.into_builder();
    problem.robot = problem.robot.with_end_effector(Some(last), mount);
    let (angles, lengths) = Problem::base_sizes(&problem.robot);
    problem.task.free_joints = vec![true; last + 1];
    problem.task.end_effector = Some(EndEffectorGoal {
        frame,
        position: Some([0.7, 0.4, -0.3][..lengths].to_vec()),
        position_tolerance: 0.01,
        orientation: Some([0.5, -0.2, 0.9][..angles].to_vec()),
        orientation_tolerance: 0.1,
    });
    problem.cost.duration = 0.3;
    problem.task.duration = Interval::new(1.0, 5.0);
    problem.build().unwrap()
}
