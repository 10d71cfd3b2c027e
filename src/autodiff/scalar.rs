//! The number type that model code is generic over.

use super::Times;
use nalgebra::{ClosedAddAssign, ClosedMulAssign, ClosedSubAssign};
use num_traits::{One, Zero};
use std::f64::consts::FRAC_PI_2;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A real number that may carry derivatives along.
///
/// A new number type implements [`Scalar::chain`] and the arithmetic; every elementary function
/// follows from it. What is linear is arithmetic and never goes through `chain`: a sum, the
/// negative, a multiple by an `f64`.
///
/// An `f64` may stand on the right of every operator. On the left of a number of any type it stands
/// as [`Real`](super::Real).
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
    + Div<f64, Output = Self>
    + DivAssign
    + AddAssign<f64>
    + SubAssign<f64>
    + MulAssign<f64>
    + DivAssign<f64>
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

    /// A whole power; one for the power zero, whatever the value.
    #[inline]
    fn powi(self, power: i32) -> Self {
        match power {
            0 => Self::one(),
            1 => self,
            _ => {
                let (v, n) = (self.value(), f64::from(power));
                let second = n * (n - 1.0) * v.powi(power.saturating_sub(2));
                self.chain(v.powi(power), n * v.powi(power.saturating_sub(1)), second)
            }
        }
    }

    /// A constant power, of a positive number where it is not whole.
    #[inline]
    fn powf(self, power: f64) -> Self {
        if power == 0.0 {
            return Self::one();
        }
        if power == 1.0 {
            return self;
        }
        let v = self.value();
        let second = power * (power - 1.0) * v.powf(power - 2.0);
        self.chain(v.powf(power), power * v.powf(power - 1.0), second)
    }

    /// Tangent of an angle, rad.
    #[inline]
    fn tan(self) -> Self {
        let tan = self.value().tan();
        let first = 1.0 + tan * tan;
        self.chain(tan, first, 2.0 * tan * first)
    }

    /// Angle with this sine, −π/2 to π/2.
    #[inline]
    fn asin(self) -> Self {
        let v = self.value();
        let first = 1.0 / ((1.0 - v) * (1.0 + v)).sqrt();
        self.chain(v.asin(), first, v * first * first * first)
    }

    /// Angle with this cosine, 0 to π.
    #[inline]
    fn acos(self) -> Self {
        -self.asin() + FRAC_PI_2
    }

    /// Angle with this tangent, −π/2 to π/2.
    #[inline]
    fn atan(self) -> Self {
        let v = self.value();
        let first = 1.0 / (1.0 + v * v);
        self.chain(v.atan(), first, -2.0 * v * first * first)
    }

    /// Angle of the point (`x`, self) from the axis of x, −π to π; not smooth at the origin.
    #[inline]
    fn atan2(self, x: Self) -> Self {
        let (y_value, x_value) = (self.value(), x.value());
        let angle = y_value.atan2(x_value);
        // The smaller over the larger: the angle but for a multiple of a right one.
        let part = if x_value.abs() >= y_value.abs() {
            (self / x).atan()
        } else {
            -(x / self).atan()
        };
        part + (angle - part.value())
    }

    /// Hyperbolic tangent.
    #[inline]
    fn tanh(self) -> Self {
        let tanh = self.value().tanh();
        let first = (1.0 - tanh) * (1.0 + tanh);
        self.chain(tanh, first, -2.0 * tanh * first)
    }

    /// Square.
    #[inline]
    fn square(self) -> Self {
        self * self
    }

    /// The larger one, with its derivatives; `self` where both are equal. NaN where either is.
    ///
    /// Use it instead of `if` on values: [`Trace`](super::Trace) does not see what that leaves out.
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
