//! Mass properties as a file gives them, before they are known to be those of a body.

use crate::config::faults::Faults;
use crate::config::{ConfigError, Place, Remedy};
use crate::dynamics::{Inertia, InertiaError, Placement};
use nalgebra::{Matrix3, Vector3};

/// Mass properties that cannot be used as they are.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Unusable {
    /// They could not be read.
    Unread(Faults),
    /// No body has them.
    Unphysical(Box<Figures>, InertiaError),
}

impl Unusable {
    /// What is wrong with them; `moves` says whether a joint moves the body.
    pub(super) fn faults(self, moves: bool) -> Vec<ConfigError> {
        match self {
            Self::Unread(faults) => faults.into_list(),
            Self::Unphysical(figures, cause) => vec![figures.fault(&cause, moves)],
        }
    }
}

/// Mass properties as a file gives them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Figures {
    /// Where the inertia stands, and what it is called.
    pub place: Place,
    pub key: String,
    /// kg.
    pub mass: f64,
    /// Rotational inertia about the mass centre, kg m².
    pub own: Matrix3<f64>,
    /// By how much rounding may have changed each of its components.
    pub rounding: Matrix3<f64>,
    /// The axes of the inertia at the mass centre, in the body's frame.
    pub pose: Placement,
}

/// Part of the largest moment by which a change is still taken for rounding.
const SLIGHT: f64 = 0.05;

impl Figures {
    /// The inertia of a part of a body.
    ///
    /// # Errors
    /// [`InertiaError`] where no part of a body has these figures.
    pub(super) fn inertia(&self) -> Result<Inertia, InertiaError> {
        let inertia = Inertia::part(self.mass, Vector3::zeros(), self.own)?;
        Ok(inertia.placed(&self.pose.rotation, &self.pose.translation))
    }

    /// The nearest inertia that a body can have, with its principal moments, kg m².
    ///
    /// # Errors
    /// What can be done where a joint `moves` the body and no rounding explains the change: a
    /// guess would plan another robot's motion.
    pub(super) fn repaired(&self, moves: bool) -> Result<(Inertia, [f64; 3]), Remedy> {
        if self.mass == 0.0 {
            // Without mass, the nearest is none at all.
            return match moves {
                true => Err(Remedy::Mass),
                false => Ok((Inertia::massless(), [0.0; 3])),
            };
        }
        let nearest = Inertia::nearest(self.mass, &self.own);
        let change = (nearest.rotational() - self.own).abs();
        let slight = SLIGHT * self.own.amax();
        let rounded = change.zip_map(&self.rounding, |change, rounding| {
            change <= rounding.max(slight)
        });
        if moves && !rounded.iter().all(|rounded| *rounded) {
            return Err(Remedy::Correct(nearest.moments()));
        }
        let placed = nearest.placed(&self.pose.rotation, &self.pose.translation);
        Ok((placed, nearest.moments()))
    }

    /// The fault that these figures are, with what can be done about it.
    pub(super) fn fault(&self, cause: &InertiaError, moves: bool) -> ConfigError {
        ConfigError::Unphysical {
            place: self.place.clone(),
            key: self.key.clone(),
            cause: cause.clone(),
            remedy: self.repaired(moves).err().unwrap_or(Remedy::Repair),
        }
    }
}

/// The size of one in the last digit of a number as it is written: 0.01 for "0.25" and for "3e-2".
pub(super) fn last_digit(number: &str) -> f64 {
    let (digits, exponent) = match number.split_once(['e', 'E']) {
        Some((digits, exponent)) => (digits, exponent.parse().unwrap_or(0)),
        None => (number, 0),
    };
    let decimals = digits
        .split_once('.')
        .map_or(0, |(_, decimals)| decimals.len());
    10f64.powi(exponent - i32::try_from(decimals).unwrap_or(i32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figures(own: [f64; 3], rounding: f64) -> Figures {
        Figures {
            place: Place {
                source: "r.urdf".into(),
                line: Some(1),
            },
            key: "link".into(),
            mass: 1.0,
            own: Matrix3::from_diagonal(&own.into()),
            rounding: Matrix3::repeat(rounding),
            pose: Placement::identity(),
        }
    }

    #[test]
    fn the_last_digit_is_as_written() {
        for (text, size) in [
            ("0.25", 0.01),
            ("3e-2", 0.01),
            ("1.50E1", 0.1),
            ("7", 1.0),
            ("-0.100", 0.001),
        ] {
            assert!((last_digit(text) / size - 1.0).abs() < 1e-12, "{text}");
        }
    }

    #[test]
    fn a_moving_body_is_repaired_where_rounding_explains_it() {
        // Two decimals: 0.0149, 0.0149 and 0.0251 may have been meant.
        let coarse = figures([0.01, 0.01, 0.03], 0.005);
        let (inertia, _) = coarse.repaired(true).unwrap();
        assert!((inertia.rotational().m33 - 0.08 / 3.0).abs() < 1e-15);
        let fine = figures([0.01, 0.01, 0.03], 5e-7);
        assert!(matches!(fine.repaired(true), Err(Remedy::Correct(_))));
        assert_eq!(
            fine.repaired(false).unwrap(),
            coarse.repaired(true).unwrap()
        );
        assert!(figures([0.01, 0.01, 0.0205], 5e-7).repaired(true).is_ok());
    }

    #[test]
    fn an_inertia_without_mass_is_none_at_rest_and_a_question_in_motion() {
        let spin = Figures {
            mass: 0.0,
            ..figures([1e-3; 3], 0.0)
        };
        assert_eq!(spin.repaired(true), Err(Remedy::Mass));
        assert_eq!(spin.repaired(false).unwrap().0, Inertia::massless());
    }
}
