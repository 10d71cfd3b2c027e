//! Derivatives that a problem computes by its own structure.

use super::Point;

/// First and second derivatives of (x, u, p, t) ↦ (f, C, ℒ, g) at one point, with scratch of their own.
///
/// One is made for each thread that evaluates.
pub trait PointDerivatives: Send {
    /// Writes the Jacobian, a row for each of f, C, ℒ, g and a column for each of x, u, p, t.
    fn jacobian(&mut self, point: Point<'_, f64>, jacobian: &mut [f64]);

    /// Writes the lower triangle of Σ `weights`·∇²(f, C, ℒ, g), by rows of the square matrix.
    fn hessian(&mut self, point: Point<'_, f64>, weights: &[f64], hessian: &mut [f64]);

    /// How many numbers [`PointDerivatives::keep`] writes; none where an evaluation has nothing to
    /// leave to the next.
    fn kept(&self) -> usize {
        0
    }

    /// Writes what the last evaluation found out that another one at the same point needs again;
    /// nothing into a slice of no length.
    fn keep(&mut self, kept: &mut [f64]) {
        let _ = kept;
    }

    /// Takes up what [`PointDerivatives::keep`] wrote, or zeros, or nothing: the next evaluation is the same
    /// with it as without, and faster where it is at the same point.
    fn recall(&mut self, kept: &[f64]) {
        let _ = kept;
    }
}
