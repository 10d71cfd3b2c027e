//! Limits that have bounds by component.

use super::checks::{Checked, count, error, indexed, interval};
use crate::ocp::Interval;
use crate::problem::builder::ProblemBuilder;
use crate::problem::components::ComponentKind;
use crate::problem::error::ProblemError;
use crate::problem::limit_id::LimitId;

pub(super) fn check(problem: &ProblemBuilder) -> Checked {
    every_bound(problem)?;
    base_motion(problem)?;
    rotation_angles(problem)
}

fn every_bound(problem: &ProblemBuilder) -> Checked {
    for entry in problem.limits.entries() {
        let key = entry.id.key();
        let expected = problem.component_count(entry.components);
        let what = match entry.components {
            ComponentKind::Joint => "joints",
            ComponentKind::BaseAttitude if problem.has_rotation_angle() => "base rotation angles",
            ComponentKind::BaseAttitude | ComponentKind::BaseRate => "base angles",
            ComponentKind::BasePosition => "base lengths",
            ComponentKind::Base => "bases",
        };
        count(&key, entry.bounds.len(), expected, what)?;
        for (i, bound) in entry.bounds.iter().enumerate() {
            interval(&indexed(&key, i, expected), bound)?;
        }
    }
    Ok(())
}

/// What is bounded has to be weighed, and told apart from the motion of the joints.
fn base_motion(problem: &ProblemBuilder) -> Checked {
    let (most, cost) = (problem.limits.base_motion, &problem.cost);
    let key = LimitId::BaseMotion.key();
    if most == f64::INFINITY {
        return Ok(());
    }
    if most.is_nan() || most <= 0.0 {
        return Err(error(key, most.to_string(), "a number above zero"));
    }
    let mut on_base = cost.entries().filter(|entry| entry.components.is_on_base());
    if !on_base.any(|entry| entry.weights.iter().any(|weight| *weight > 0.0)) {
        let found = "a cost without a weight on the base";
        return Err(error(
            key,
            found,
            "a weight on the base, such as cost.base_rate",
        ));
    }
    if cost.rate_matrix.is_some() {
        let found = "cost.rate_matrix, which weighs base and joints together";
        return Err(error(key, found, "weights by component alone"));
    }
    Ok(())
}

/// A rotation angle has no sign.
fn rotation_angles(problem: &ProblemBuilder) -> Checked {
    if !problem.has_rotation_angle() {
        return Ok(());
    }
    let on_attitude = |components| components == ComponentKind::BaseAttitude;
    for entry in problem.limits.entries() {
        for Interval { lower, upper } in entry.bounds {
            if on_attitude(entry.components) && *lower != -*upper {
                let found = format!("[{lower}, {upper}]");
                let expected = "a symmetric bound, the largest rotation angle";
                return Err(error(entry.id.key(), found, expected));
            }
        }
    }
    Ok(())
}

/// The bounds along the path that the base at the start is outside of.
pub(super) fn start(problem: &ProblemBuilder) -> Vec<ProblemError> {
    let mut faults = Vec::new();
    for entry in problem.limits.entries() {
        let (what, at) = match entry.id {
            LimitId::BaseAttitude => ("attitude", problem.limited_start_attitude()),
            LimitId::BasePosition => ("position", vec![0.0; entry.bounds.len()]),
            _ => continue,
        };
        // What was measured on the way may be off by its last digit.
        let room = |at: f64| 1e-12 * at.abs();
        for (i, (bound, at)) in entry.bounds.iter().zip(at).enumerate() {
            if bound.violation(at) > room(at) {
                faults.push(error(
                    indexed(&entry.id.key(), i, entry.bounds.len()),
                    format!("[{}, {}]", bound.lower, bound.upper),
                    format!("a range around {at}, the {what} at the start"),
                ));
            }
        }
    }
    faults
}
