//! Where the joints start and end: well within their limits, and off each other's axes.

use super::choice::Choice;
use crate::config::robot::{Outline, OutlineJoint};
use crate::dynamics::JointKind;

/// Postures that are tried.
pub(super) const ATTEMPTS: usize = 4;

/// A task for the joints that move.
#[derive(Debug)]
pub(super) struct Ends {
    /// Name, start and goal, rad or m.
    pub joints: Vec<(String, f64, f64)>,
    /// s.
    pub duration: f64,
}

/// The task of the joints that `choice` lets move.
pub(super) fn ends(robot: &Outline, choice: &Choice, attempt: usize) -> Ends {
    let joints = robot.joints.iter().zip(&choice.locked);
    let moving = joints.filter(|(_, locked)| locked.is_none());
    let mut duration: f64 = 20.0;
    let joints = moving.enumerate().map(|(i, (joint, _))| {
        let (start, goal) = positions(joint, i, attempt);
        // The largest speed of a smooth motion is below twice its mean.
        duration = duration.max(4.0 * (goal - start).abs() / joint.limits.velocity);
        (joint.name.clone(), start, goal)
    });
    Ends {
        joints: joints.collect(),
        duration: duration.ceil(),
    }
}

fn positions(joint: &OutlineJoint, i: usize, attempt: usize) -> (f64, f64) {
    let [lower, upper] = joint.limits.position;
    let range = upper - lower;
    let (free, longest): (f64, f64) = match joint.kind {
        JointKind::Revolute => (0.3, 0.6),
        JointKind::Prismatic => (0.03, 0.1),
    };
    let room = 0.1 * if range.is_finite() { range } else { 0.0 };
    let (lowest, highest) = (lower + room, upper - room);
    let sign = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
    let wanted = sign * free * (1 + attempt) as f64;
    let start = wanted.max(lowest).min(highest);
    let way = longest.min(0.3 * range);
    let goal = if start + way <= highest {
        start + way
    } else {
        start - way
    };
    // No more digits than the room has.
    let digit = 10f64.powf(range.min(1.0).log10().floor() - 2.0);
    let round = |value: f64| {
        let rounded = (value / digit).round() * digit;
        format!("{rounded:.12}").parse::<f64>().unwrap_or(rounded)
    };
    match digit > 0.0 {
        true => (round(start), round(goal)),
        // A joint that its limits hold.
        false => (start, goal),
    }
}
