//! Pairs kept apart: bodies that are there and differ, finite numbers, sizes above zero, no two
//! solids without volume and no two boxes.

use super::checks::{Checked, error};
use crate::problem::builder::ProblemBuilder;
use crate::problem::keep_out::{KeepOut, Solid};
use crate::problem::limit_id::LimitId;

pub(super) fn check(problem: &ProblemBuilder) -> Checked {
    for (i, one) in problem.limits.keep_out.iter().enumerate() {
        let key = format!("{}[{i}]", LimitId::KeepOut);
        pair(&key, one, problem.robot.joint_count())?;
    }
    Ok(())
}

/// Checks a pair whose key in the problem file is `key`, for a robot with `joints` joints.
pub(crate) fn pair(key: &str, pair: &KeepOut, joints: usize) -> Checked {
    let of_first = pair.first.shape.key();
    let (first, second) = (&pair.first, &pair.second);
    solid(first, joints, |rest| format!("{key}.{of_first}.{rest}"))?;
    solid(second, joints, |rest| format!("{key}.from.{rest}"))?;
    if first.has_no_volume() && second.has_no_volume() {
        let expected = "a radius above zero on one side";
        let key = format!("{key}.{of_first}.radius");
        return Err(error(key, "two solids without volume", expected));
    }
    if first.is_box() && second.is_box() {
        let expected = "one of both as spheres";
        return Err(error(
            format!("{key}.from"),
            "a box against a box",
            expected,
        ));
    }
    if first.joint == second.joint {
        let expected = "two different bodies";
        return Err(error(format!("{key}.from.body"), "the same body", expected));
    }
    Ok(())
}

fn solid(solid: &Solid, joints: usize, key: impl Fn(&str) -> String) -> Checked {
    if solid.joint.is_some_and(|joint| joint >= joints) {
        return Err(error(key("body"), "no such body", "a body of the robot"));
    }
    match solid.shape.fault() {
        Some((name, found, expected)) => Err(error(key(name), found, expected)),
        None => Ok(()),
    }
}
