//! A vector function that derivatives are taken of.

use super::Scalar;

/// A smooth function of `inputs()` variables with `outputs()` values, for any [`Scalar`].
pub trait Function {
    /// Mutable scratch for one number type.
    type Scratch<S: Scalar>: Send;

    /// Number of variables.
    fn inputs(&self) -> usize;

    /// Number of values.
    fn outputs(&self) -> usize;

    /// Fresh scratch.
    fn scratch<S: Scalar>(&self) -> Self::Scratch<S>;

    /// Writes the values at `v` (length `inputs()`) into `out` (length `outputs()`).
    fn evaluate<S: Scalar>(&self, v: &[S], scratch: &mut Self::Scratch<S>, out: &mut [S]);
}
