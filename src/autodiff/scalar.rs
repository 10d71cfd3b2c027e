//! The number type that model code is generic over.

use super::Times;
use nalgebra::{ClosedAddAssign, ClosedMulAssign, ClosedSubAssign};
use num_traits::{One, Zero};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real number that may carry derivatives along.
///
/// A new number type implements [`Scalar::chain`] and the arithmetic; every elementary function
/// follows from it. What is linear is arithmetic and never goes through `chain`: a sum, the
/// negative, a multiple by an `f64`.
pub trait Scalar:
    nalgebra::Scalar
    + Copy
    + Send
    + Sync
    + Zero
    + One
    + ClosedAddAssign
    + ClosedSubAssign
    + ClosedMulAssign
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Times<Self>
    + Times<f64>
{
    /// A constant: all derivatives are zero.
    fn constant(value: f64) -> Self;

    /// The value without its derivatives.
    fn value(&self) -> f64;

    /// φ(self) for a nonlinear univariate φ with the given value, first and second derivative at
    /// `self.value()`.
    fn chain(self, value: f64, first: f64, second: f64) -> Self;

    /// Sine and cosine of an angle, rad.
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.value().sin_cos();
        (self.chain(s, c, -s), self.chain(c, -s, -c))
    }

    /// Sine of an angle, rad.
    #[inline]
    fn sin(self) -> Self {
        self.sin_cos().0
    }

    /// Cosine of an angle, rad.
    #[inline]
    fn cos(self) -> Self {
        self.sin_cos().1
    }

    /// 1 / self.
    #[inline]
    fn recip(self) -> Self {
        let r = 1.0 / self.value();
        self.chain(r, -r * r, 2.0 * r * r * r)
    }

    /// Square root.
    #[inline]
    fn sqrt(self) -> Self {
        let root = self.value().sqrt();
        let first = 0.5 / root;
        self.chain(root, first, -0.5 * first / self.value())
    }

    /// Exponential function.
    #[inline]
    fn exp(self) -> Self {
        let e = self.value().exp();
        self.chain(e, e, e)
    }

    /// Natural logarithm.
    #[inline]
    fn ln(self) -> Self {
        let r = 1.0 / self.value();
        self.chain(self.value().ln(), r, -r * r)
    }

    /// Square.
    #[inline]
    fn square(self) -> Self {
        self * self
    }

    /// The larger one, with its derivatives; `self` where both are equal. NaN where either is.
    ///
    /// Use it instead of `if` on values, which [`Trace`](super::Trace) does not see.
    #[inline]
    fn max(self, other: Self) -> Self {
        let own = self.value();
        if own >= other.value() || own.is_nan() {
            self
        } else {
            other
        }
    }

    /// The smaller one, with its derivatives; `self` where both are equal. NaN where either is.
    #[inline]
    fn min(self, other: Self) -> Self {
        let own = self.value();
        if own <= other.value() || own.is_nan() {
            self
        } else {
            other
        }
    }

    /// Absolute value; at zero the derivatives are those of positive numbers.
    #[inline]
    fn abs(self) -> Self {
        if self.value() < 0.0 { -self } else { self }
    }
}

impl Scalar for f64 {
    #[inline]
    fn constant(value: f64) -> Self {
        value
    }

    #[inline]
    fn value(&self) -> f64 {
        *self
    }

    #[inline]
    fn chain(self, value: f64, _first: f64, _second: f64) -> Self {
        value
    }
}
