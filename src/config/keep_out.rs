//! `[[limits.keep_out]]`: pairs kept apart.

use super::ConfigError;
use super::document::quoted;
use super::item::{Item, Section, hint};
use super::robot::Robot;
use crate::dynamics::Placement;
use crate::problem::{KeepOut, ProblemError, Shape, Solid, check_pair};
use nalgebra::Vector3;

/// The array of pairs.
pub(super) fn read(item: &Item<'_>, robot: &Robot) -> Result<Vec<KeepOut>, ConfigError> {
    let expected = "tables [[limits.keep_out]], each with sphere, capsule or collision, and from";
    let entries = item
        .as_elements()
        .ok_or_else(|| item.unexpected(expected))?;
    let mut found = Vec::new();
    for entry in &entries {
        found.extend(pairs(entry, robot)?);
    }
    Ok(found)
}

/// The pairs of one entry: one, or every shape of a body with every shape of the other.
fn pairs(item: &Item<'_>, robot: &Robot) -> Result<Vec<KeepOut>, ConfigError> {
    let section = item.section(&["name", "sphere", "capsule", "collision", "from"])?;
    let given: Vec<&Item<'_>> = ["sphere", "capsule", "collision"]
        .iter()
        .filter_map(|key| section.get(key))
        .collect();
    let (firsts, carrier) = match given[..] {
        [item] if item.name == "collision" => collisions(item, robot)?,
        [item] if item.name == "capsule" => one(capsule(item, robot)?),
        [item] => one(sphere(item, robot)?),
        [] => {
            let expected = "a table with body, center and radius; or capsule, or collision";
            return Err(section.missing("sphere", expected));
        }
        [_, second, ..] => {
            let expected = "one of sphere, capsule and collision";
            return Err(second.error("more than one of them", expected));
        }
    };
    let expected = "a table with body, center and radius, with body, ends and radius for a \
                    capsule, with body, center and half for a box, or with collision";
    let from = section.require("from", expected)?;
    let (seconds, _) = if has(from, "collision") {
        let name = from.section(&["collision"])?;
        collisions(name.require("collision", BODY)?, robot)?
    } else if has(from, "half") {
        one(cuboid(from, robot)?)
    } else if has(from, "ends") {
        one(capsule(from, robot)?)
    } else {
        one(sphere(from, robot)?)
    };
    let name = match section.get("name") {
        Some(item) => item.text("a string")?.into(),
        None => format!("clearance of {carrier}"),
    };
    let several = firsts.len() * seconds.len() > 1;
    let mut found = Vec::new();
    for first in &firsts {
        for second in &seconds {
            if first.is_box() && second.is_box() {
                let expected = "one of both as spheres or capsules, for two boxes cannot be \
                                measured against each other";
                return Err(from.error("a box against a box", expected));
            }
            let number = found.len() + 1;
            let pair = KeepOut {
                name: match several {
                    true => format!("{name}, {number}"),
                    false => name.clone(),
                },
                first: first.clone(),
                second: second.clone(),
            };
            // Here, where the entry is known that it comes from.
            check_pair(&item.key, &pair, usize::MAX).map_err(|error| blame(item, error))?;
            found.push(pair);
        }
    }
    Ok(found)
}

/// An error below the entry `item`, with the place of its key.
fn blame(item: &Item<'_>, error: ProblemError) -> ConfigError {
    let below = error.key.strip_prefix(&item.key).unwrap_or_default();
    ConfigError::Value {
        place: item.node.locate(below.trim_start_matches('.')),
        key: error.key,
        found: error.found,
        expected: error.expected,
    }
}

/// A single solid.
fn one((solid, name): Named<'_>) -> (Vec<Solid>, &str) {
    (vec![solid], name)
}

/// The shapes that a URDF gives for the body that `item` names.
fn collisions<'a>(item: &Item<'a>, robot: &Robot) -> Result<(Vec<Solid>, &'a str), ConfigError> {
    let (joint, placement) = find(item, robot)?;
    let name = item.text(BODY)?;
    let shapes = robot.collisions(name)?;
    if shapes.is_empty() {
        let expected = "a body with <collision> elements in a URDF, or a sphere or a capsule here";
        return Err(item.error(quoted(name), expected));
    }
    let placed = shapes.iter().map(|shape| Solid {
        joint,
        shape: shape.placed(&placement),
    });
    Ok((placed.collect(), name))
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
