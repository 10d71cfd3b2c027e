//! The smooth two-link case with an end effector.

use crate::problems;
use ffsm_ipopt::dynamics::Placement;
use ffsm_ipopt::planner::Plan;
use ffsm_ipopt::problem::Problem;

/// The smooth two-link case with an end effector at the forearm's end.
pub fn two_link() -> Problem {
    let tip = Placement::from_xyz_rpy([0.35 + 0.156, 0.0, 0.0], [0.0; 3]);
    let robot = problems::two_link().with_end_effector(Some(1), tip);
    problems::smooth()
        .edited(|problem| problem.robot = robot)
        .unwrap()
}

/// Where the two-link arm's end effector is at t_f: inertial position from the system's mass
/// centre, and heading.
pub fn tip(plan: &Plan) -> ([f64; 2], f64) {
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
