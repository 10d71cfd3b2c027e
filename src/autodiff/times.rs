//! Products with factors that carry derivatives, or that are plain numbers and cost less.

use std::ops::{Add, Sub};

/// A number that can be multiplied by factors of type `K`: numbers of its own type, or `f64`.
pub trait Times<K: Copy>: Copy + Add<Output = Self> + Sub<Output = Self> {
    /// self·factor.
    fn times(self, factor: K) -> Self;

    /// self + a·factor.
    #[inline(always)]
    fn plus_times(self, a: Self, factor: K) -> Self {
        self + a.times(factor)
    }

    /// self − a·factor.
    #[inline(always)]
    fn minus_times(self, a: Self, factor: K) -> Self {
        self - a.times(factor)
    }
}

impl Times<f64> for f64 {
    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        self * factor
    }
}
