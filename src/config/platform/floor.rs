//! `[bearing]`, `[floor]`, `[[pads]]` and `[air]`.

use super::{MOST, not_negative, pair};
use crate::config::ConfigError;
use crate::config::document::quoted;
use crate::config::item::{Item, Section};
use crate::dynamics::Model;
use crate::simulate::{Air, Pad, Platform};

/// Reads `[bearing]` and `[floor]`.
pub(super) fn floor(root: &Section<'_>, platform: &mut Platform) -> Result<(), ConfigError> {
    let bearing = &mut platform.bearing;
    if let Some(item) = root.get("bearing") {
        let section = item.section(&[
            "friction",
            "film_drag",
            "slip_speed",
            "base_pads",
            "base_circle",
        ])?;
        not_negative(
            &section,
            &mut [
                ("friction", &mut bearing.friction),
                ("film_drag", &mut bearing.film_drag),
                ("base_circle", &mut bearing.base_circle),
            ],
        )?;
        if let Some(item) = section.get("slip_speed") {
            bearing.slip_speed = item.positive("a finite speed above zero, m/s")?;
        }
        if let Some(item) = section.get("base_pads") {
            bearing.base_pads = item.count(MOST)?;
        }
    }
    let floor = &mut platform.floor;
    if let Some(item) = root.get("floor") {
        let section = item.section(&["tilt", "gravity"])?;
        if let Some(item) = section.get("tilt") {
            let expected = "[along x, along y], two angles below 0.1, rad";
            floor.tilt = pair(item, expected)?;
            if floor.tilt.iter().any(|angle| angle.abs() >= 0.1) {
                return Err(item.unexpected(expected));
            }
        }
        if let Some(item) = section.get("gravity") {
            floor.gravity = item.positive("a finite acceleration above zero, m/s²")?;
        }
    }
    Ok(())
}

/// `[[pads]]`.
pub(super) fn pads(item: &Item<'_>, robot: &Model) -> Result<Vec<Pad>, ConfigError> {
    let expected = "one [[pads]] table a pad";
    let names: Vec<&str> = std::iter::once(robot.base())
        .chain(robot.joints().iter().map(|joint| &joint.body))
        .map(|body| body.name.as_str())
        .collect();
    let pad = |item: &Item<'_>| {
        let section = item.section(&["body", "at", "load"])?;
        let body = section.require("body", "the name of a body")?;
        let name = body.text("the name of a body")?;
        let found = names.iter().position(|body| *body == name);
        let expected = || format!("a body of the robot: {}", names.join(", "));
        Ok(Pad {
            body: found.ok_or_else(|| body.error(quoted(name), expected()))?,
            at: match section.get("at") {
                Some(item) => item.triple("[x, y, z] in the body's frame, m")?,
                None => [0.0; 3],
            },
            load: match section.get("load") {
                Some(item) => Some(item.positive("a finite mass above zero, kg")?),
                None => None,
            },
        })
    };
    item.as_elements()
        .filter(|elements| !elements.is_empty())
        .ok_or_else(|| item.unexpected(expected))?
        .iter()
        .map(pad)
        .collect()
}

/// `[air]`: one drag area for every body, or a table by body.
pub(super) fn air(item: &Item<'_>, robot: &Model) -> Result<Air, ConfigError> {
    let section = item.section(&["density", "drag_area"])?;
    let mut air = Air::default();
    if let Some(item) = section.get("density") {
        air.density = item.positive("a finite density above zero, kg/m³")?;
    }
    if let Some(item) = section.get("drag_area") {
        let bodies = crate::config::values::Components {
            what: "body",
            names: std::iter::once(robot.base())
                .chain(robot.joints().iter().map(|joint| &joint.body))
                .map(|body| body.name.clone())
                .collect(),
            single: None,
        };
        air.drag_area = bodies.weights(item)?;
    }
    Ok(air)
}
