//! The optimal control problem as a trait.

use super::{Ends, Formulation, InteriorPoint, Point, PointDerivatives};
use crate::autodiff::Scalar;

/// An optimal control problem in Bolza form, eq. (17) and (18).
///
/// Minimise Φ(ends) + ∫ℒ dt subject to ẋ = f, bounds on integrals ∫g dt, path and boundary
/// constraints and bounds, over states, controls, static parameters, t₀ and the duration. All
/// functions are generic over [`Scalar`], from which values, gradients and Hessians follow; they
/// must be smooth where they are evaluated. Sparsity follows from their operations, recorded by
/// [`Trace`](crate::autodiff::Trace); a problem that branches on values says so by
/// [`Ocp::has_branches`].
pub trait Ocp: Sync {
    /// Mutable scratch for one number type, so that nothing is allocated in the solve.
    type Scratch<S: Scalar>: Send;

    /// Quantities and bounds. Called at set-up only.
    fn formulation(&self) -> Formulation;

    /// Fresh scratch.
    fn scratch<S: Scalar>(&self) -> Self::Scratch<S>;

    /// Writes f into `rates` and the path rows C into `path`; returns the running cost ℒ.
    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rates: &mut [S],
        path: &mut [S],
    ) -> S;

    /// Writes the integrands g of [`Formulation::integrals`] into `integrands`.
    ///
    /// It is called right after [`Ocp::continuous`], at the same point and with the same scratch.
    fn integrands<S: Scalar>(
        &self,
        point: Point<'_, S>,
        scratch: &mut Self::Scratch<S>,
        integrands: &mut [S],
    ) {
        let _ = (point, scratch, integrands);
    }

    /// Writes the boundary rows E into `rows`; returns the terminal cost Φ.
    fn boundary<S: Scalar>(
        &self,
        ends: Ends<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) -> S {
        let _ = (ends, scratch, rows);
        S::zero()
    }

    /// Writes the rows of a way-point into `rows`.
    fn way_point<S: Scalar>(
        &self,
        point: InteriorPoint<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) {
        let _ = (point, scratch, rows);
    }

    /// Derivatives of [`Ocp::continuous`] and [`Ocp::integrands`] by the problem's own structure, where it has any that
    /// beat dual numbers swept over the whole function.
    fn derivatives(&self) -> Option<Box<dyn PointDerivatives + '_>> {
        None
    }

    /// Whether the functions branch by `if` or `match` on values, so that operations of one branch
    /// say nothing of another's. Every derivative is then kept in the sparsity pattern.
    ///
    /// `max`, `min` and `abs` of [`Scalar`] are no such branches.
    fn has_branches(&self) -> bool {
        false
    }
}
