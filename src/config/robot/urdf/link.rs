//! `<link>`: a name, its `<inertial>`, what it fills and what it looks like.

use super::element::{Attribute, Element};
use super::material::Materials;
use super::{collision, origin, visual};
use crate::config::faults::Faults;
use crate::config::figures::{Figures, Unusable, last_digit};
use crate::config::robot::bodies::Bodies;
use crate::config::robot::look::Look;
use crate::config::{ConfigError, Place};
use crate::dynamics::Inertia;
use crate::problem::Shape;
use nalgebra::Matrix3;

/// A link with its mass properties in its own frame.
#[derive(Debug)]
pub(super) struct Link {
    pub place: Place,
    pub name: String,
    /// Its mass properties, massless where it has no `<inertial>`.
    pub inertia: Result<Inertia, Unusable>,
    pub has_inertial: bool,
    /// What it fills, part by part; an error where a part is none of the shapes that are read.
    pub collisions: Vec<Result<Shape, ConfigError>>,
    /// What is drawn of it.
    pub looks: Vec<Look>,
}

impl Link {
    /// Whether it is known to have no mass.
    pub(super) fn is_frame(&self) -> bool {
        self.inertia
            .as_ref()
            .is_ok_and(|inertia| inertia.mass() == 0.0)
    }
}

/// Reads a link, changed as `bodies` say; `None` for one without a name, which is a fault.
pub(super) fn read(
    element: &Element<'_, '_>,
    (bodies, materials): (&Bodies, &Materials<'_>),
    faults: &mut Faults,
) -> Option<Link> {
    let name = faults.keep(element.name("name"))?;
    let inertial = element.child("inertial");
    let has_inertial = !matches!(inertial, Ok(None)) || bodies.has(&name);
    let inertia = match inertial {
        Ok(Some(inertial)) => inertia(&inertial, |figures| bodies.change(&name, figures)),
        Ok(None) => bodies.whole(&name),
        Err(fault) => Err(Unusable::Unread(Faults::from(fault))),
    };
    let parts = element.children("collision");
    Some(Link {
        place: element.place(),
        name,
        inertia,
        has_inertial,
        collisions: parts.iter().map(collision::read).collect(),
        looks: visual::read(element, materials),
    })
}

/// The figures of the file, with others laid over them by `change`.
fn inertia(
    element: &Element<'_, '_>,
    change: impl FnOnce(&mut Figures),
) -> Result<Inertia, Unusable> {
    let mut faults = Faults::default();
    let mass = faults.keep(mass(element));
    let pose = faults.keep(origin(element));
    let expected = "ixx, ixy, ixz, iyy, iyz and izz, kg m²";
    let figures = faults.keep(element.require("inertia", expected));
    let figures = figures.and_then(|element| {
        let moments = moments(&element, &mut faults)?;
        Some((element, moments))
    });
    let (Some(mass), Some(pose), Some((element, (own, rounding)))) = (mass, pose, figures) else {
        return Err(Unusable::Unread(faults));
    };
    let mut figures = Figures {
        place: element.place(),
        key: element.path().into(),
        mass,
        own,
        rounding,
        pose,
    };
    change(&mut figures);
    // Judged as it stands in the file, not as turned.
    figures
        .inertia()
        .map_err(|cause| Unusable::Unphysical(Box::new(figures), cause))
}

fn mass(element: &Element<'_, '_>) -> Result<f64, ConfigError> {
    let expected = "a finite mass of zero or above, kg";
    let element = element.require("mass", expected)?;
    let value = element.attribute("value", expected)?;
    match value.finite(expected)? {
        mass if mass < 0.0 => Err(value.unexpected(expected)),
        mass => Ok(mass),
    }
}

/// The matrix of inertia, and by how much each of its figures may be rounded.
fn moments(element: &Element<'_, '_>, faults: &mut Faults) -> Option<(Matrix3<f64>, Matrix3<f64>)> {
    let expected = "a finite number, kg m²";
    let mut moment = |name| {
        let attribute = faults.keep(element.attribute(name, expected))?;
        let value = faults.keep(attribute.finite(expected))?;
        Some((value, rounding(&attribute)))
    };
    let read = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"].map(&mut moment);
    let [xx, xy, xz, yy, yz, zz] = read;
    let (xx, xy, xz, yy, yz, zz) = (xx?, xy?, xz?, yy?, yz?, zz?);
    let matrix = |of: fn(&(f64, f64)) -> f64| {
        let [xx, xy, xz, yy, yz, zz] = [xx, xy, xz, yy, yz, zz].map(|figure| of(&figure));
        Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
    };
    Some((matrix(|figure| figure.0), matrix(|figure| figure.1)))
}

fn rounding(attribute: &Attribute<'_, '_, '_>) -> f64 {
    0.5 * last_digit(attribute.text)
}
