//! `[[limits.keep_out]]`: pairs kept apart.

use super::ConfigError;
use super::document::quoted;
use super::item::{Item, hint};
use super::robot::Robot;
use crate::problem::{KeepOut, Obstacle, Sphere};
use nalgebra::Vector3;

/// The array of pairs.
pub(super) fn read(item: &Item<'_>, robot: &Robot) -> Result<Vec<KeepOut>, ConfigError> {
    let expected = "tables [[limits.keep_out]], each with sphere and from";
    let pairs = item
        .as_elements()
        .ok_or_else(|| item.unexpected(expected))?;
    pairs.iter().map(|pair| one(pair, robot)).collect()
}

fn one(item: &Item<'_>, robot: &Robot) -> Result<KeepOut, ConfigError> {
    let section = item.section(&["name", "sphere", "from"])?;
    let expected = "a table with body, center and radius";
    let (sphere, carrier) = sphere(section.require("sphere", expected)?, robot)?;
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
        Obstacle::Sphere(self::sphere(from, robot)?.0)
    };
    let name = match section.get("name") {
        Some(item) => item.text("a string")?.into(),
        None => format!("clearance of {carrier}"),
    };
    Ok(KeepOut { name, sphere, from })
}

/// A sphere, in the frame of the body that carries it, and the name it was given by: that of a
/// body, or of one that has become part of another.
fn sphere<'a>(item: &Item<'a>, robot: &Robot) -> Result<(Sphere, &'a str), ConfigError> {
    let section = item.section(&["body", "center", "radius"])?;
    let expected = "a body of the robot";
    let body = section.require("body", expected)?;
    let name = body.text(expected)?;
    let Some((joint, placement)) = robot.body(name) else {
        let names = robot.body_names();
        return Err(body.error(quoted(name), format!("{expected}; {}", hint(name, &names))));
    };
    let expected = "[x, y, z] in the body's frame, m";
    let center = match section.get("center") {
        Some(item) => item.triple(expected)?,
        None => [0.0; 3],
    };
    let expected = "a finite length, m, zero or above";
    let radius = section.require("radius", expected)?.number(expected)?;
    let center = placement.rotation * Vector3::from(center) + placement.translation;
    let sphere = Sphere {
        joint,
        center: center.into(),
        radius,
    };
    Ok((sphere, name))
}
