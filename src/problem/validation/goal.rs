//! A goal of the end effector, at t_f or at a way-point.

use super::checks::{Checked, error, length, numbers};
use crate::dynamics::Model;
use crate::problem::components::base_sizes;
use crate::problem::goal::EndEffectorGoal;
use crate::problem::magnitude::POSITION;

/// Checks the goal of `robot` that stands under `key`.
pub(super) fn check(goal: &EndEffectorGoal, key: &str, robot: &Model) -> Checked {
    if robot.end_effector().is_none() {
        let expected = "a robot with an end effector";
        return Err(error(key, "a goal for the end effector", expected));
    }
    if goal.position.is_none() && goal.orientation.is_none() {
        return Err(error(key, "neither", "a position, an orientation or both"));
    }
    let (angles, lengths) = base_sizes(robot);
    if let Some(position) = &goal.position {
        let key = format!("{key}.position");
        numbers(&key, position, (lengths, "base lengths"), POSITION)?;
    }
    if let Some(orientation) = &goal.orientation {
        let key = format!("{key}.orientation");
        numbers(&key, orientation, (angles, "base angles"), POSITION)?;
    }
    length(format!("{key}.position_tolerance"), goal.position_tolerance)?;
    if !(0.0..1.5).contains(&goal.orientation_tolerance) {
        let key = format!("{key}.orientation_tolerance");
        let expected = "an angle from 0 to below 1.5 rad";
        return Err(error(key, goal.orientation_tolerance, expected));
    }
    Ok(())
}
