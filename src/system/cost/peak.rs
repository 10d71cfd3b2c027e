//! The largest value of a quantity of the base along the path: a static parameter that the path rows
//! of [`PeakRow`] hold it below.

use super::breakdown::Side;
use super::term::EndTerm;
use crate::autodiff::Scalar;
use crate::dynamics::space::Space;
use crate::problem::{CostId, Problem};
use crate::system::instant::Pose;
use crate::system::rows::PeakRow;

/// A weighted static parameter.
#[derive(Debug, Clone)]
pub(crate) struct PeakTerm {
    id: CostId,
    parameter: usize,
    weight: f64,
}

impl PeakTerm {
    /// The terms of `problem`, one a peak that has a weight.
    pub fn all(problem: &Problem) -> impl Iterator<Item = Self> {
        PeakRow::all(problem).into_iter().map(|row| {
            let (parameter, weight) = row.weighted_parameter();
            Self {
                id: row.cost(),
                parameter,
                weight,
            }
        })
    }
}

impl<Sp: Space> EndTerm<Sp> for PeakTerm {
    fn id(&self) -> CostId {
        self.id
    }

    fn side(&self) -> Side {
        Side::Base
    }

    fn value<S: Scalar>(&self, at: &Pose<'_, Sp, S>) -> S {
        at.parameters[self.parameter] * self.weight
    }
}
