//! `<collision>`: the shape of a part of a link.

use super::element::Element;
use super::origin;
use crate::config::ConfigError;
use crate::problem::Shape;
use nalgebra::Vector3;

/// Reads a box, a sphere or a cylinder, in the link's frame; for a cylinder the capsule that holds
/// it, with the same axis and radius.
pub(super) fn read(element: &Element<'_, '_>) -> Result<Shape, ConfigError> {
    let expected = "a box, a cylinder or a sphere";
    let pose = origin(element)?;
    let geometry = element.require("geometry", expected)?;
    let length = |element: &Element<'_, '_>, name| {
        let expected = "a finite length above zero, m";
        let attribute = element.attribute(name, expected)?;
        match attribute.finite(expected)? {
            length if length > 0.0 => Ok(length),
            _ => Err(attribute.unexpected(expected)),
        }
    };
    let center = pose.translation.into();
    if let Some(sphere) = geometry.child("sphere")? {
        let radius = length(&sphere, "radius")?;
        return Ok(Shape::Sphere { center, radius });
    }
    if let Some(cylinder) = geometry.child("cylinder")? {
        let radius = length(&cylinder, "radius")?;
        let half = 0.5 * length(&cylinder, "length")?;
        let end = |z: f64| (pose.translation + pose.rotation * Vector3::new(0.0, 0.0, z)).into();
        return Ok(Shape::Capsule {
            ends: [end(-half), end(half)],
            radius,
        });
    }
    if let Some(cuboid) = geometry.child("box")? {
        let expected = "3 finite lengths above zero, m";
        let size = cuboid.attribute("size", expected)?;
        let half = size.triple(expected)?.map(|edge| 0.5 * edge);
        if half.iter().any(|half| *half <= 0.0) {
            return Err(size.unexpected(expected));
        }
        return Ok(Shape::Box {
            center,
            rotation: pose.rotation,
            half,
        });
    }
    let found = match geometry.child("mesh")? {
        Some(_) => "a mesh",
        None => "none of these shapes",
    };
    Err(element.error(found, expected))
}
