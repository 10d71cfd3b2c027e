//! What a user should know of how a robot was read, though nothing is wrong.

use super::description::Entry;
use crate::ocp::Interval;
use crate::problem::Problem;

/// Deviation from the plane (rad, m, relative) below which a plane may have been meant.
const NEARLY: f64 = 2e-3;
/// What is not worth mentioning of it.
const ROUNDING: f64 = 1e-12;

/// The notes on the robot of `problem`, whose joints are `entries`, read from `path`.
pub(super) fn of(entries: &[Entry], path: &str, problem: &Problem) -> Vec<String> {
    let unlimited = entries
        .iter()
        .enumerate()
        .filter_map(|(j, entry)| unlimited(j, entry, problem));
    unlimited.chain(nearly_planar(path, problem)).collect()
}

/// Limits that the file leaves out and the problem does not give either.
fn unlimited(j: usize, entry: &Entry, problem: &Problem) -> Option<String> {
    let missing = entry.unlimited;
    let limits = &problem.limits;
    let infinite = |bound: &Interval| bound.lower.is_infinite() || bound.upper.is_infinite();
    let names: Vec<&str> = [
        ("position", missing.position, &limits.joint_position[j]),
        ("velocity", missing.velocity, &limits.joint_velocity[j]),
        ("effort", missing.effort, &limits.torque[j]),
    ]
    .into_iter()
    .filter(|(_, missing, bound)| *missing && infinite(bound))
    .map(|(name, ..)| name)
    .collect();
    if names.is_empty() {
        return None;
    }
    Some(format!(
        "{}: joint '{}': no limit on {} (absent or 0), taken as unlimited; limits of the problem \
         file can set one",
        entry.place,
        entry.joint.name,
        names.join(", ")
    ))
}

/// A robot in space that misses a plane by no more than rounded figures would.
fn nearly_planar(path: &str, problem: &Problem) -> Option<String> {
    let robot = &problem.robot;
    if robot.plane().is_some() {
        return None;
    }
    let deviation = robot.deviation_from_plane()?;
    if !deviation.within(NEARLY) {
        return None;
    }
    let parts = [
        (deviation.tilt, "axes differ by", " rad"),
        (deviation.height, "mass centres differ along them by", " m"),
        (
            deviation.product,
            "products of inertia are",
            " of the moments",
        ),
    ];
    let parts: Vec<String> = parts
        .into_iter()
        .filter(|(size, ..)| *size > ROUNDING)
        .map(|(size, text, unit)| format!("{text} {size:.1e}{unit}"))
        .collect();
    Some(format!(
        "{path}: nearly planar, and treated in space: {}. Where a plane is meant, give angles with \
         all their digits (π/2 is 1.5707963267948966)",
        parts.join(", ")
    ))
}
