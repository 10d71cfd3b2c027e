//! Pairs kept apart.

use super::checks::{Checked, error, length};
use crate::problem::builder::ProblemBuilder;
use crate::problem::keep_out::{KeepOut, Obstacle};
use crate::problem::limit_id::LimitId;

pub(super) fn check(problem: &ProblemBuilder) -> Checked {
    for (i, pair) in problem.limits.keep_out.iter().enumerate() {
        let key = format!("{}[{i}]", LimitId::KeepOut);
        sizes(&key, pair)?;
        centers(&key, pair)?;
        not_two_points(&key, pair)?;
        bodies(&key, pair, problem.robot.joint_count())?;
    }
    Ok(())
}

fn sizes(key: &str, pair: &KeepOut) -> Checked {
    match &pair.from {
        Obstacle::Sphere(other) => length(format!("{key}.from.radius"), other.radius)?,
        Obstacle::Box { half, .. } => {
            if let Some(h) = half.iter().find(|h| !(h.is_finite() && **h > 0.0)) {
                let expected = "finite lengths above zero, m";
                return Err(error(format!("{key}.from.half"), h, expected));
            }
        }
    }
    length(format!("{key}.sphere.radius"), pair.sphere.radius)
}

fn centers(key: &str, pair: &KeepOut) -> Checked {
    let other = match &pair.from {
        Obstacle::Sphere(other) => &other.center,
        Obstacle::Box { center, .. } => center,
    };
    let mut numbers = pair.sphere.center.iter().chain(other);
    match numbers.find(|c| !c.is_finite()) {
        Some(c) => Err(error(format!("{key}.sphere.center"), c, "finite numbers")),
        None => Ok(()),
    }
}

fn not_two_points(key: &str, pair: &KeepOut) -> Checked {
    match &pair.from {
        Obstacle::Sphere(other) if pair.sphere.radius + other.radius == 0.0 => Err(error(
            format!("{key}.sphere.radius"),
            "two points",
            "a radius above zero on one side",
        )),
        _ => Ok(()),
    }
}

fn bodies(key: &str, pair: &KeepOut, joints: usize) -> Checked {
    let other = match &pair.from {
        Obstacle::Sphere(other) => other.joint,
        Obstacle::Box { .. } => None,
    };
    let carriers = [pair.sphere.joint, other];
    if carriers.iter().flatten().any(|&joint| joint >= joints) {
        return Err(error(
            format!("{key}.sphere.body"),
            "no such body",
            "a body of the robot",
        ));
    }
    if carriers[0] == carriers[1] {
        let expected = "two different bodies";
        return Err(error(format!("{key}.from.body"), "the same body", expected));
    }
    Ok(())
}
