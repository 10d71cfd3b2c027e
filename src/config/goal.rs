//! `[task.final]` with an end-effector goal.

use super::ConfigError;
use super::document::quoted;
use super::item::Item;
use super::values::Components;
use crate::problem::{EndEffectorGoal, GoalFrame};

/// `end_effector`.
pub(super) fn end_effector(
    item: &Item<'_>,
    angles: &Components,
    lengths: &Components,
) -> Result<EndEffectorGoal, ConfigError> {
    let section = item.section(&[
        "frame",
        "position",
        "position_tolerance",
        "orientation",
        "orientation_tolerance",
    ])?;
    let expected = "\"inertial\", \"start\" or \"base\"";
    let item = section.require("frame", expected)?;
    let name = item.text(expected)?;
    let frames = [GoalFrame::Inertial, GoalFrame::Start, GoalFrame::Base];
    let frame = frames.into_iter().find(|frame| frame.name() == name);
    let frame = frame.ok_or_else(|| item.error(quoted(name), expected))?;
    let vector = |name: &str, components: &Components| match section.get(name) {
        Some(item) => components.vector(item).map(Some),
        None => Ok(None),
    };
    let tolerance = |name: &str| match section.get(name) {
        Some(item) => item.number("a finite number, zero or above"),
        None => Ok(0.0),
    };
    Ok(EndEffectorGoal {
        frame,
        position: vector("position", lengths)?,
        position_tolerance: tolerance("position_tolerance")?,
        orientation: vector("orientation", angles)?,
        orientation_tolerance: tolerance("orientation_tolerance")?,
    })
}

/// Joint positions beside an end-effector goal, and which of them are free.
///
/// `joints` may name some joints only; where the others end is for the planner to find, which
/// begins at `guess`, or at the start.
pub(super) fn joints(
    given: Option<&Item<'_>>,
    guess: Option<&Item<'_>>,
    joints: &Components,
    initial: &[f64],
) -> Result<(Vec<f64>, Vec<bool>), ConfigError> {
    let mut at = match guess {
        Some(item) => joints.vector(item)?,
        None => initial.to_vec(),
    };
    let mut free = vec![true; at.len()];
    let Some(item) = given else {
        return Ok((at, free));
    };
    let Some(entries) = item.as_entries() else {
        return Ok((joints.vector(item)?, vec![false; at.len()]));
    };
    for (j, item) in joints.by_name(entries)?.into_iter().enumerate() {
        if let Some(item) = item {
            at[j] = item.number("a finite number")?;
            free[j] = false;
        }
    }
    Ok((at, free))
}
