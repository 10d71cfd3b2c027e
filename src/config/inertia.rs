//! Mass properties of a body: the keys `mass`, `com` and `inertia`.

use super::ConfigError;
use super::figures::{Figures, Unusable, last_digit};
use super::item::{Item, Section};
use crate::dynamics::{Inertia, InertiaError, Placement, Quantity};
use nalgebra::{Matrix3, Vector3};

/// Reads the mass properties among the keys of `section`.
pub(super) fn read(section: &Section<'_>) -> Result<Inertia, ConfigError> {
    let figures = figures(section)?;
    body(&figures).map_err(|cause| ConfigError::Inertia {
        place: figures.place,
        key: figures.key,
        cause,
    })
}

/// Those of a body of a robot, where they are figures; whether a body can have them is another
/// matter.
///
/// `change` may lay other figures over them first.
pub(super) fn read_body(
    section: &Section<'_>,
    change: impl FnOnce(&mut Figures),
) -> Result<Result<Inertia, Unusable>, ConfigError> {
    let mut figures = figures(section)?;
    change(&mut figures);
    let inertia = body(&figures);
    Ok(inertia.map_err(|cause| Unusable::Unphysical(Box::new(figures), cause)))
}

fn body(figures: &Figures) -> Result<Inertia, InertiaError> {
    Inertia::new(figures.mass, figures.pose.translation, figures.own)
}

fn figures(section: &Section<'_>) -> Result<Figures, ConfigError> {
    let mass_item = section.require("mass", "a finite mass above zero, kg")?;
    let mass = mass_item.positive("a finite mass above zero, kg")?;
    let center = match section.get("com") {
        Some(item) => item.triple("an array of 3 lengths, m")?,
        None => [0.0; 3],
    };
    let item = section.require("inertia", EXPECTED)?;
    let own = matrix(item)?;
    if let Err(cause @ InertiaError::TooLarge { quantity, .. }) =
        Inertia::new(mass, center.into(), own)
    {
        let item = match quantity {
            Quantity::Mass => mass_item,
            Quantity::Center => section.get("com").unwrap_or(mass_item),
            Quantity::Inertia => item,
        };
        return Err(ConfigError::Inertia {
            place: item.node.place.clone(),
            key: item.key.clone(),
            cause,
        });
    }
    Ok(Figures {
        place: item.node.place.clone(),
        key: item.key.clone(),
        mass,
        own,
        // As the shortest way to write the number has it.
        rounding: own.map(|figure| 0.5 * last_digit(&format!("{figure:e}"))),
        pose: Placement::from_xyz_rpy(center, [0.0; 3]),
    })
}

pub(super) const EXPECTED: &str =
    "a number, [Ixx, Iyy, Izz] or a 3×3 matrix about the mass centre, kg m²";

/// A rotational inertia: one number for all axes, the diagonal, or rows.
pub(super) fn matrix(item: &Item<'_>) -> Result<Matrix3<f64>, ConfigError> {
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
