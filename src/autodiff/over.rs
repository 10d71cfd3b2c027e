//! Products with factors that carry derivatives, or that are plain numbers and cost less.

use super::Scalar;

/// A number that products with factors of type `K` can be taken of: itself or `f64`.
pub trait Over<K: Copy>: Scalar {
    /// self·factor.
    fn over(self, factor: K) -> Self;
    /// self + a·factor.
    fn plus(self, a: Self, factor: K) -> Self;
    /// self − a·factor.
    fn minus(self, a: Self, factor: K) -> Self;
}

impl<S: Scalar> Over<f64> for S {
    #[inline(always)]
    fn over(self, factor: f64) -> Self {
        self * factor
    }

    #[inline(always)]
    fn plus(self, a: Self, factor: f64) -> Self {
        self.plus_multiple(a, factor)
    }

    #[inline(always)]
    fn minus(self, a: Self, factor: f64) -> Self {
        self.plus_multiple(a, -factor)
    }
}
