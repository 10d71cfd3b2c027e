//! The joint positions and rates at the ends of the motion.

use super::checks::{Checked, error, indexed};
use crate::ocp::Interval;
use crate::problem::builder::ProblemBuilder;
use crate::problem::error::ProblemError;
use crate::problem::limit_id::LimitId;
use crate::problem::unit::Unit;

/// Where start and goal are outside of the limits of the joints.
pub(super) fn within_limits(problem: &ProblemBuilder) -> Vec<ProblemError> {
    let (task, limits) = (&problem.task, &problem.limits);
    let position = (LimitId::JointPosition, &limits.joint_position[..]);
    let velocity = (LimitId::JointVelocity, &limits.joint_velocity[..]);
    let all = |values: &[f64]| values.iter().copied().map(Some).collect::<Vec<_>>();
    let given = task.final_joints.iter().zip(&task.free_joints);
    let given: Vec<_> = given.map(|(q, free)| (!free).then_some(*q)).collect();
    let within = |key, values: &[Option<f64>], limit| outside(problem, key, values, limit);
    let mut faults = within("task.initial.joints", &all(&task.initial_joints), position);
    faults.extend(within("task.final.joints", &given, position));
    faults.extend(within(
        "task.initial.rates",
        &all(&task.initial_rates),
        velocity,
    ));
    faults
}

/// Those of `values` that are given, one a joint, and outside of `bounds`.
fn outside(
    problem: &ProblemBuilder,
    key: &str,
    values: &[Option<f64>],
    (limit, bounds): (LimitId, &[Interval]),
) -> Vec<ProblemError> {
    let mut faults = Vec::new();
    for (i, (value, bound)) in values.iter().zip(bounds).enumerate() {
        let Some(value) = value.filter(|value| bound.violation(*value) > 0.0) else {
            continue;
        };
        let joint = &problem.robot.joints()[i];
        let unit = Unit::position(joint.kind);
        faults.push(error(
            indexed(key, i, values.len()),
            format!("{value} {unit} for joint '{}'", joint.name),
            format!("a value within {limit}, [{}, {}]", bound.lower, bound.upper),
        ));
    }
    faults
}

/// No joint can move without moving any mass at the positions that the task names, as with bodies
/// that have none: no torque belongs to a motion there.
pub(super) fn move_mass(problem: &ProblemBuilder) -> Checked {
    let ProblemBuilder { robot, task, .. } = problem;
    let at = |key: String, joints: &[f64]| match robot.massless_joint_at(joints) {
        Some(joint) => Err(error(
            key,
            format!(
                "joint '{}' can move there without moving any mass",
                robot.joints()[joint].name
            ),
            "positions at which bodies without mass do not make joints interchangeable",
        )),
        None => Ok(()),
    };
    at("task.initial.joints".into(), &task.initial_joints)?;
    for (i, point) in task.way_points.iter().enumerate() {
        let joints: Option<Vec<f64>> = point.joints.iter().copied().collect();
        if let Some(joints) = joints {
            at(format!("{}.joints", LimitId::WayPoint(i)), &joints)?;
        }
    }
    if task.free_joints.contains(&true) {
        return Ok(());
    }
    at(LimitId::FinalJoints.key().into_owned(), &task.final_joints)
}
