//! `[[limits.keep_out]]`: pairs kept apart.

use super::ConfigError;
use super::document::quoted;
use super::item::{Item, Section, hint};
use super::robot::Robot;
use crate::dynamics::Placement;
use crate::problem::{KeepOut, Shape, Solid};
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
    let section = item.section(&["name", "sphere", "capsule", "from"])?;
    let expected = "a table with body, center and radius, or capsule";
    let (first, carrier) = match (section.get("capsule"), section.get("sphere")) {
        (Some(item), None) => capsule(item, robot)?,
        (Some(item), Some(_)) => {
            return Err(item.error("sphere as well", "either sphere or capsule"));
        }
        (None, _) => sphere(section.require("sphere", expected)?, robot)?,
    };
    let expected = "a table with body, center and radius, with body, ends and radius for a \
                    capsule, or with body, center and half for a box";
    let from = section.require("from", expected)?;
    let (second, _) = if has(from, "half") {
        cuboid(from, robot)?
    } else if has(from, "ends") {
        capsule(from, robot)?
    } else {
        sphere(from, robot)?
    };
    let name = match section.get("name") {
        Some(item) => item.text("a string")?.into(),
        None => format!("clearance of {carrier}"),
    };
    Ok(KeepOut {
        name,
        first,
        second,
    })
}

/// Whether it is a table with that key.
fn has(item: &Item<'_>, key: &str) -> bool {
    item.as_entries()
        .is_some_and(|entries| entries.iter().any(|entry| entry.name == key))
}

/// A solid and the name of the body that it was given for: one of the robot's, or one that has
/// become part of another.
type Named<'a> = (Solid, &'a str);

fn sphere<'a>(item: &Item<'a>, robot: &Robot) -> Result<Named<'a>, ConfigError> {
    let section = item.section(&["body", "center", "radius"])?;
    let body = section.require("body", BODY)?;
    let (joint, placement) = find(body, robot)?;
    let center = match section.get("center") {
        Some(item) => item.triple(POINT)?,
        None => [0.0; 3],
    };
    let radius = radius(&section)?;
    let center = placed(&placement, center);
    Ok((Solid::sphere(joint, center, radius), body.text(BODY)?))
}

fn capsule<'a>(item: &Item<'a>, robot: &Robot) -> Result<Named<'a>, ConfigError> {
    let section = item.section(&["body", "ends", "radius"])?;
    let body = section.require("body", BODY)?;
    let (joint, placement) = find(body, robot)?;
    let expected = "the two ends of the axis, [[x, y, z], [x, y, z]] in the body's frame, m";
    let ends = section.require("ends", expected)?;
    let [a, b] = &ends.as_elements().unwrap_or_default()[..] else {
        return Err(ends.unexpected(expected));
    };
    let ends = [a.triple(expected)?, b.triple(expected)?].map(|end| placed(&placement, end));
    let solid = Solid::capsule(joint, ends, radius(&section)?);
    Ok((solid, body.text(BODY)?))
}

fn cuboid<'a>(item: &Item<'a>, robot: &Robot) -> Result<Named<'a>, ConfigError> {
    let section = item.section(&["body", "center", "half"])?;
    let (joint, placement, name) = match section.get("body") {
        Some(body) => {
            let (joint, placement) = find(body, robot)?;
            (joint, placement, body.text(BODY)?)
        }
        None => (None, Placement::identity(), "base"),
    };
    let center = section.require("center", POINT)?.triple(POINT)?;
    let expected = "half of each edge along the axes of the body's frame, [x, y, z], m";
    let half = section.require("half", expected)?.triple(expected)?;
    let shape = Shape::Box {
        center: placed(&placement, center),
        rotation: placement.rotation,
        half,
    };
    Ok((Solid { joint, shape }, name))
}

const BODY: &str = "a body of the robot";
const POINT: &str = "[x, y, z] in the body's frame, m";

fn radius(section: &Section<'_>) -> Result<f64, ConfigError> {
    let expected = "a finite length, m, zero or above";
    section.require("radius", expected)?.number(expected)
}

/// The joint whose body is or carries the one that `item` names, and the pose of its frame there.
fn find(item: &Item<'_>, robot: &Robot) -> Result<(Option<usize>, Placement), ConfigError> {
    let name = item.text(BODY)?;
    robot.body(name).ok_or_else(|| {
        let hint = hint(name, &robot.body_names());
        item.error(quoted(name), format!("{BODY}; {hint}"))
    })
}

fn placed(placement: &Placement, point: [f64; 3]) -> [f64; 3] {
    (placement.rotation * Vector3::from(point) + placement.translation).into()
}
