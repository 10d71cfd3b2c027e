//! `<link>`: a name and its `<inertial>`; what it looks like is not read.

use super::element::Element;
use super::origin;
use crate::config::{ConfigError, Place};
use crate::dynamics::{Body, Inertia};
use nalgebra::{Matrix3, Vector3};

/// A link with its mass properties in its own frame.
#[derive(Debug)]
pub(super) struct Link {
    pub place: Place,
    pub body: Body,
}

/// Reads a link; one without `<inertial>` is massless.
pub(super) fn read(element: &Element<'_, '_>) -> Result<Link, ConfigError> {
    let name = element.name("name")?;
    let inertia = match element.child("inertial")? {
        Some(inertial) => inertia(&inertial)?,
        None => Inertia::massless(),
    };
    Ok(Link {
        place: element.place(),
        body: Body { name, inertia },
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
        Err(source) => Err(ConfigError::Inertia {
            place: inertia_element.place(),
            key: inertia_element.path().into(),
            source,
        }),
    }
}
