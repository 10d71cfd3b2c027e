//! Mass properties of a body: the keys `mass`, `com` and `inertia`.

use super::ConfigError;
use super::item::{Item, Section};
use crate::dynamics::{Inertia, InertiaError, Quantity};
use nalgebra::{Matrix3, Vector3};

/// Reads the mass properties among the keys of `section`.
pub(super) fn read(section: &Section<'_>) -> Result<Inertia, ConfigError> {
    let mass_item = section.require("mass", "a finite mass above zero, kg")?;
    let mass = mass_item.positive("a finite mass above zero, kg")?;
    let center = match section.get("com") {
        Some(item) => item.triple("an array of 3 lengths, m")?.into(),
        None => Vector3::zeros(),
    };
    let inertia_item = section.require("inertia", EXPECTED)?;
    Inertia::new(mass, center, matrix(inertia_item)?).map_err(|cause| {
        let item = match cause {
            InertiaError::Mass(_)
            | InertiaError::TooLarge {
                quantity: Quantity::Mass,
                ..
            } => mass_item,
            InertiaError::Center(_)
            | InertiaError::TooLarge {
                quantity: Quantity::Center,
                ..
            } => section.get("com").unwrap_or(mass_item),
            _ => inertia_item,
        };
        ConfigError::Inertia {
            place: item.node.place.clone(),
            key: item.key.clone(),
            cause,
        }
    })
}

const EXPECTED: &str = "a number, [Ixx, Iyy, Izz] or a 3×3 matrix about the mass centre, kg m²";

fn matrix(item: &Item<'_>) -> Result<Matrix3<f64>, ConfigError> {
    if item.as_number().is_some() {
        return Ok(Matrix3::identity() * item.number(EXPECTED)?);
    }
    let elements = item
        .as_elements()
        .ok_or_else(|| item.unexpected(EXPECTED))?;
    if elements
        .iter()
        .all(|element| element.as_elements().is_none())
    {
        return Ok(Matrix3::from_diagonal(&item.triple(EXPECTED)?.into()));
    }
    let rows: Vec<_> = elements
        .iter()
        .map(|row| {
            row.triple("a row of 3 finite numbers, kg m²")
                .map(Vector3::from)
        })
        .collect::<Result<_, _>>()?;
    match rows[..] {
        [x, y, z] => Ok(Matrix3::from_columns(&[x, y, z]).transpose()),
        _ => Err(item.unexpected(EXPECTED)),
    }
}
