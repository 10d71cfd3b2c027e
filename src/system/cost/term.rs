//! What a kind of cost term says of itself.

use super::breakdown::Side;
use crate::autodiff::Scalar;
use crate::dynamics::space::Space;
use crate::problem::CostId;
use crate::system::instant::{Instant, Needs, Pose};
use crate::system::linearization::{Adjoint, Linearization, Lower};

/// A term that is integrated along the path.
pub(crate) trait PathTerm<Sp: Space> {
    /// The weights behind it.
    fn id(&self) -> CostId;

    /// Whose motion it is about.
    fn side(&self) -> Side;

    /// What is needed beyond the state.
    fn needs(&self) -> Needs {
        Needs::default()
    }

    /// The value, with its weights.
    fn value<S: Scalar>(&self, at: &Instant<'_, Sp, S>) -> S;

    /// Adds the derivatives by the inputs to `row`.
    fn gradient(&self, at: &Linearization<'_, Sp>, row: &mut [f64]);

    /// Adds to the weights on what the term is a function of.
    fn weigh(&self, at: &Linearization<'_, Sp>, weight: f64, adjoint: &mut Adjoint<'_>) {
        let _ = (at, weight, adjoint);
    }

    /// Adds second derivatives beyond those of what [`Self::weigh`] names.
    fn curvature(&self, at: &Linearization<'_, Sp>, weight: f64, hessian: &mut Lower<'_>) {
        let _ = (at, weight, hessian);
    }
}

/// A term of the end.
pub(crate) trait EndTerm<Sp: Space> {
    /// The weights behind it.
    fn id(&self) -> CostId;

    /// Whose motion it is about.
    fn side(&self) -> Side;

    /// What is needed beyond the state.
    fn needs(&self) -> Needs {
        Needs::default()
    }

    /// The value, with its weights.
    fn value<S: Scalar>(&self, at: &Pose<'_, Sp, S>) -> S;
}

/// Σ wᵢ vᵢ², leaving out what has no weight.
pub(super) fn weighted_squares<S: Scalar>(weights: &[f64], values: &[S]) -> S {
    let mut sum = S::zero();
    for (&weight, value) in weights.iter().zip(values).filter(|(w, _)| **w != 0.0) {
        sum += value.square() * weight;
    }
    sum
}

/// `weights` where any of them is above zero.
pub(super) fn some(weights: &[f64]) -> Option<Vec<f64>> {
    weights.iter().any(|w| *w > 0.0).then(|| weights.to_vec())
}
