//! `[[limits.keep_out]]`: pairs kept apart.

use super::ConfigError;
use super::document::quoted;
use super::item::{Item, hint};
use crate::dynamics::Model;
use crate::planner::{KeepOut, Obstacle, Sphere};

/// The array of pairs.
pub(super) fn read(item: &Item<'_>, robot: &Model) -> Result<Vec<KeepOut>, ConfigError> {
    let expected = "tables [[limits.keep_out]], each with sphere and from";
    let pairs = item
        .as_elements()
        .ok_or_else(|| item.unexpected(expected))?;
    pairs.iter().map(|pair| one(pair, robot)).collect()
}

fn one(item: &Item<'_>, robot: &Model) -> Result<KeepOut, ConfigError> {
    let section = item.section(&["name", "sphere", "from"])?;
    let expected = "a table with body, center and radius";
    let sphere = sphere(section.require("sphere", expected)?, robot)?;
    let expected = "a table with body, center and radius, or with center and half for a box";
    let from = section.require("from", expected)?;
    let boxed = from
        .as_entries()
        .is_some_and(|entries| entries.iter().any(|entry| entry.name == "half"));
    let from = if boxed {
        let section = from.section(&["center", "half"])?;
        let expected = "[x, y, z] in the base frame, m";
        let center = section.require("center", expected)?.triple(expected)?;
        let expected = "half of each edge along the base frame's axes, [x, y, z], m";
        let half = section.require("half", expected)?.triple(expected)?;
        Obstacle::Box { center, half }
    } else {
        Obstacle::Sphere(self::sphere(from, robot)?)
    };
    let name = match section.get("name") {
        Some(item) => item.text("a string")?.into(),
        None => format!("clearance of {}", carrier(robot, sphere.joint)),
    };
    Ok(KeepOut { name, sphere, from })
}

fn carrier(robot: &Model, joint: Option<usize>) -> &str {
    match joint {
        Some(j) => &robot.joints()[j].body.name,
        None => &robot.base().name,
    }
}

fn sphere(item: &Item<'_>, robot: &Model) -> Result<Sphere, ConfigError> {
    let section = item.section(&["body", "center", "radius"])?;
    let expected = "a body of the robot";
    let body = section.require("body", expected)?;
    let name = body.text(expected)?;
    let names: Vec<&str> = robot
        .joints()
        .iter()
        .map(|j| j.body.name.as_str())
        .collect();
    let joint = match names.iter().position(|known| *known == name) {
        Some(j) => Some(j),
        None if name == "base" || name == robot.base().name => None,
        None => {
            let all = [&names[..], &[robot.base().name.as_str()]].concat();
            return Err(body.error(quoted(name), format!("{expected}; {}", hint(name, &all))));
        }
    };
    let expected = "[x, y, z] in the body's frame, m";
    let center = match section.get("center") {
        Some(item) => item.triple(expected)?,
        None => [0.0; 3],
    };
    let expected = "a finite length, m, zero or above";
    let radius = section.require("radius", expected)?.number(expected)?;
    Ok(Sphere {
        joint,
        center,
        radius,
    })
}
