//! First-order dual numbers with several directions at a time.

use super::Scalar;
use num_traits::{One, Zero};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A value with its derivatives in `N` directions: v + Σ dᵢ εᵢ, εᵢεⱼ = 0.
///
/// The derivatives lie in one array so that the compiler turns each operation into vector
/// instructions over the directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual<const N: usize> {
    /// The value v.
    pub value: f64,
    /// The derivatives dᵢ.
    pub gradient: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// A variable whose derivative is one in direction `lane` and zero in the others.
    #[inline]
    pub fn seeded(value: f64, lane: usize) -> Self {
        let mut gradient = [0.0; N];
        gradient[lane] = 1.0;
        Self { value, gradient }
    }

    /// v and gradient α·a + β·b: what every operation comes down to.
    #[inline]
    fn combine(value: f64, alpha: f64, a: &[f64; N], beta: f64, b: &[f64; N]) -> Self {
        let mut gradient = [0.0; N];
        for i in 0..N {
            gradient[i] = alpha * a[i] + beta * b[i];
        }
        Self { value, gradient }
    }
}

impl<const N: usize> Scalar for Dual<N> {
    #[inline]
    fn constant(value: f64) -> Self {
        Self {
            value,
            gradient: [0.0; N],
        }
    }

    #[inline]
    fn value(&self) -> f64 {
        self.value
    }

    #[inline]
    fn chain(self, value: f64, first: f64, _second: f64) -> Self {
        Self {
            value,
            gradient: self.gradient.map(|g| first * g),
        }
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    #[inline]
    fn add(mut self, rhs: Self) -> Self {
        self += rhs;
        self
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    #[inline]
    fn sub(mut self, rhs: Self) -> Self {
        self -= rhs;
        self
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    #[inline]
    fn mul(self, rhs: Self) -> Self {
        Self::combine(
            self.value * rhs.value,
            rhs.value,
            &self.gradient,
            self.value,
            &rhs.gradient,
        )
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    #[inline]
    fn div(self, rhs: Self) -> Self {
        let r = 1.0 / rhs.value;
        let quotient = self.value * r;
        Self::combine(quotient, r, &self.gradient, -quotient * r, &rhs.gradient)
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            gradient: self.gradient.map(|g| -g),
        }
    }
}

impl<const N: usize> AddAssign for Dual<N> {
    #[inline]
    fn add_assign(&mut self, rhs: Self) {
        self.value += rhs.value;
        for (a, b) in self.gradient.iter_mut().zip(rhs.gradient) {
            *a += b;
        }
    }
}

impl<const N: usize> SubAssign for Dual<N> {
    #[inline]
    fn sub_assign(&mut self, rhs: Self) {
        self.value -= rhs.value;
        for (a, b) in self.gradient.iter_mut().zip(rhs.gradient) {
            *a -= b;
        }
    }
}

impl<const N: usize> MulAssign for Dual<N> {
    #[inline]
    fn mul_assign(&mut self, rhs: Self) {
        *self = *self * rhs;
    }
}

impl<const N: usize> Add<f64> for Dual<N> {
    type Output = Self;
    #[inline]
    fn add(mut self, rhs: f64) -> Self {
        self.value += rhs;
        self
    }
}

impl<const N: usize> Sub<f64> for Dual<N> {
    type Output = Self;
    #[inline]
    fn sub(mut self, rhs: f64) -> Self {
        self.value -= rhs;
        self
    }
}

impl<const N: usize> Mul<f64> for Dual<N> {
    type Output = Self;
    #[inline]
    fn mul(self, rhs: f64) -> Self {
        Self {
            value: self.value * rhs,
            gradient: self.gradient.map(|g| g * rhs),
        }
    }
}

impl<const N: usize> Zero for Dual<N> {
    #[inline]
    fn zero() -> Self {
        Self::constant(0.0)
    }

    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl<const N: usize> One for Dual<N> {
    #[inline]
    fn one() -> Self {
        Self::constant(1.0)
    }
}
