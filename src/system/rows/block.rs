//! What a kind of rows says of itself.

use super::row::Row;
use crate::autodiff::Scalar;
use crate::dynamics::space::Space;
use crate::system::instant::{Instant, Needs, Pose};
use crate::system::linearization::{Adjoint, Linearization, Lower};

/// Rows held at every collocation point.
pub(crate) trait PathRows<Sp: Space> {
    /// Limits, units and bounds, one a row.
    fn rows(&self) -> &[Row];

    /// What is needed beyond the state.
    fn needs(&self) -> Needs {
        Needs::default()
    }

    /// Writes the values.
    fn values<S: Scalar>(&self, at: &Instant<'_, Sp, S>, rows: &mut [S]);

    /// Adds the derivatives by the inputs to `rows`, each [`Linearization::width`] wide.
    fn gradient(&self, at: &Linearization<'_, Sp>, rows: &mut [f64]);

    /// Adds to the weights on what the rows are functions of.
    fn weigh(&self, at: &Linearization<'_, Sp>, weights: &[f64], adjoint: &mut Adjoint<'_>) {
        let _ = (at, weights, adjoint);
    }

    /// Adds second derivatives beyond those of what [`Self::weigh`] names.
    fn curvature(&self, at: &Linearization<'_, Sp>, weights: &[f64], hessian: &mut Lower<'_>) {
        let _ = (at, weights, hessian);
    }
}

/// Rows held at t_f, which is no collocation point.
pub(crate) trait EndRows<Sp: Space> {
    /// Limits, units and bounds, one a row.
    fn rows(&self) -> &[Row];

    /// What is needed beyond the state.
    fn needs(&self) -> Needs {
        Needs {
            end_pose: true,
            ..Needs::default()
        }
    }

    /// Writes the values.
    fn values<S: Scalar>(&self, at: &Pose<'_, Sp, S>, rows: &mut [S]);
}
