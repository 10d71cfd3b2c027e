//! Limits on the base's rate, eq. (10): η̇ where η are angles, else the angular velocity.

use super::{BoundId, Component, PathRows, Row};
use crate::autodiff::Scalar;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::problem::{LimitId, Problem, Unit};
use crate::system::instant::Instant;
use crate::system::linearization::{Adjoint, Linearization};
use crate::system::plant::Plant;

/// One row a component of the base's rate.
#[derive(Debug, Clone)]
pub(crate) struct BaseRateRows(Vec<Row>);

impl BaseRateRows {
    /// The rows of `problem`; `None` where no component is limited.
    pub fn new<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> Option<Self> {
        let bounds = &problem.limits.base_rate;
        let angles = plant.attitude.is_angles();
        let row = |(i, bounds)| {
            let (component, name) = if angles {
                let name = format!("{} rate", plant.attitude.names()[i]);
                (Component::Attitude(i), name)
            } else {
                let name = format!("base angular velocity {}", ["x", "y", "z"][i]);
                (Component::Axis(i), name)
            };
            let id = BoundId::new(LimitId::BaseRate, component);
            Row::new(id, Unit::RadianPerSecond, name, bounds)
        };
        bounds
            .iter()
            .any(|bound| !bound.is_free())
            .then(|| Self(bounds.iter().copied().enumerate().map(row).collect()))
    }
}

impl<Sp: Space> PathRows<Sp> for BaseRateRows {
    fn rows(&self) -> &[Row] {
        &self.0
    }

    fn values<S: Scalar>(&self, at: &Instant<'_, Sp, S>, rows: &mut [S]) {
        rows.copy_from_slice(at.base_rate);
    }

    fn gradient(&self, at: &Linearization<'_, Sp>, rows: &mut [f64]) {
        for (i, row) in rows.chunks_exact_mut(at.width()).enumerate() {
            row[..at.states()].copy_from_slice(at.base_rate_by(i));
        }
    }

    fn weigh(&self, _at: &Linearization<'_, Sp>, weights: &[f64], adjoint: &mut Adjoint<'_>) {
        for (to, weight) in adjoint.base_rate.iter_mut().zip(weights) {
            *to += weight;
        }
    }
}
