//! `<link>`: a name, its `<inertial>` and what it fills; what it looks like is not read.

use super::element::Element;
use super::{collision, origin};
use crate::config::{ConfigError, Place};
use crate::dynamics::{Body, Inertia};
use crate::problem::Shape;
use nalgebra::{Matrix3, Vector3};

/// A link with its mass properties in its own frame.
#[derive(Debug)]
pub(super) struct Link {
    pub place: Place,
    pub body: Body,
    /// What it fills, part by part; an error where a part is none of the shapes that are read.
    pub collisions: Vec<Result<Shape, ConfigError>>,
}

/// Reads a link; one without `<inertial>` is massless.
pub(super) fn read(element: &Element<'_, '_>) -> Result<Link, ConfigError> {
    let name = element.name("name")?;
    let inertia = match element.child("inertial")? {
        Some(inertial) => inertia(&inertial)?,
        None => Inertia::massless(),
    };
    let parts = element.children("collision");
    Ok(Link {
        place: element.place(),
        body: Body { name, inertia },
        collisions: parts.iter().map(collision::read).collect(),
    })
}

fn inertia(element: &Element<'_, '_>) -> Result<Inertia, ConfigError> {
    let expected = "a finite mass of zero or above, kg";
    let mass_element = element.require("mass", expected)?;
    let value = mass_element.attribute("value", expected)?;
    let mass = value.finite(expected)?;
    if mass < 0.0 {
        return Err(value.unexpected(expected));
    }
    let pose = origin(element)?;
    let inertia_element = element.require("inertia", "ixx, ixy, ixz, iyy, iyz and izz, kg m²")?;
    let moment = |name| {
        let expected = "a finite number, kg m²";
        inertia_element.attribute(name, expected)?.finite(expected)
    };
    let (xx, xy, xz) = (moment("ixx")?, moment("ixy")?, moment("ixz")?);
    let (yy, yz, zz) = (moment("iyy")?, moment("iyz")?, moment("izz")?);
    let own = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    // Judged as it stands in the file, not as turned.
    match Inertia::part(mass, Vector3::zeros(), own) {
        Ok(inertia) => Ok(inertia.placed(&pose.rotation, &pose.translation)),
        Err(cause) => Err(ConfigError::Inertia {
            place: inertia_element.place(),
            key: inertia_element.path().into(),
            cause,
        }),
    }
}
