//! `[[task.way_points]]`: where the arm is to be on its way.

use super::ConfigError;
use super::goal;
use super::item::Item;
use super::values::Components;
use crate::problem::{Moment, WayPoint};

/// The array of way-points.
pub(super) fn read(
    item: &Item<'_>,
    joints: &Components,
    angles: &Components,
    lengths: &Components,
) -> Result<Vec<WayPoint>, ConfigError> {
    let expected = "tables [[task.way_points]], each with time or fraction";
    let points = item
        .as_elements()
        .ok_or_else(|| item.unexpected(expected))?;
    points
        .iter()
        .map(|point| one(point, joints, angles, lengths))
        .collect()
}

fn one(
    item: &Item<'_>,
    joints: &Components,
    angles: &Components,
    lengths: &Components,
) -> Result<WayPoint, ConfigError> {
    let section = item.section(&[
        "time",
        "fraction",
        "joints",
        "joint_rates",
        "end_effector",
        "guess",
    ])?;
    let at = match (section.get("time"), section.get("fraction")) {
        (Some(item), None) => Moment::Time(item.number("a time, s")?),
        (None, Some(item)) => Moment::Fraction(item.number("a fraction of the duration")?),
        (Some(_), Some(item)) => {
            return Err(item.error("time as well", "either time, s, or fraction"));
        }
        (None, None) => {
            let expected = "a time, s, or fraction, that of the duration";
            return Err(section.missing("time", expected));
        }
    };
    let all = |value| vec![value; joints.names.len()];
    Ok(WayPoint {
        at,
        joints: match section.get("joints") {
            Some(item) => joints.some(item)?,
            None => all(None),
        },
        joint_rates: match section.get("joint_rates") {
            // One for all: typically 0, to stop there.
            Some(item) if item.as_number().is_some() => all(Some(item.number("a finite rate")?)),
            Some(item) => joints.some(item)?,
            None => all(None),
        },
        end_effector: match section.get("end_effector") {
            Some(item) => Some(goal::end_effector(item, angles, lengths)?),
            None => None,
        },
        guess: match section.get("guess") {
            Some(item) => Some(joints.vector(item)?),
            None => None,
        },
    })
}
