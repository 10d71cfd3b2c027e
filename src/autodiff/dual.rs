//! First-order dual numbers with several directions at a time.

use super::{Scalar, Times};
use num_traits::{One, Zero};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A value with its derivatives in `N` directions: v + Σ dᵢ εᵢ, εᵢεⱼ = 0.
///
/// The derivatives lie in one array so that the compiler turns each operation into vector
/// instructions over the directions. `FUSED` numbers round a product and a sum once: only for
/// code that [`dispatch`](super::dispatch) runs, since the operation is a slow function call
/// where the processor lacks it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C, align(32))]
pub struct Dual<const N: usize, const FUSED: bool = false> {
    /// The derivatives dᵢ.
    pub gradient: [f64; N],
    /// The value v.
    pub value: f64,
}

impl<const N: usize, const FUSED: bool> Dual<N, FUSED> {
    /// One in each direction, zero in the others.
    const UNITS: [[f64; N]; N] = {
        let mut units = [[0.0; N]; N];
        let mut direction = 0;
        while direction < N {
            units[direction][direction] = 1.0;
            direction += 1;
        }
        units
    };

    /// Adds `by` to the derivative in `direction`.
    ///
    /// By a whole vector: to write one number where vectors are read next stalls the processor.
    #[inline(always)]
    pub fn add_derivative(&mut self, direction: usize, by: f64) {
        let unit = &Self::UNITS[direction];
        for (derivative, &one) in self.gradient.iter_mut().zip(unit) {
            *derivative = plus_product::<FUSED>(*derivative, by, one);
        }
    }

    /// A variable whose derivative is one in `direction` and zero in the others.
    #[inline(always)]
    pub fn seeded(value: f64, direction: usize) -> Self {
        let mut gradient = [0.0; N];
        gradient[direction] = 1.0;
        Self { value, gradient }
    }

    /// Another value, the derivatives times `factor`.
    // A loop: closures are not surely inlined into code for wide vectors.
    #[inline(always)]
    fn scaled(mut self, value: f64, factor: f64) -> Self {
        self.value = value;
        for i in 0..N {
            self.gradient[i] *= factor;
        }
        self
    }

    /// v and gradient α·a + β·b: what every operation comes down to.
    #[inline(always)]
    fn combine(value: f64, alpha: f64, a: &[f64; N], beta: f64, b: &[f64; N]) -> Self {
        let mut gradient = [0.0; N];
        for i in 0..N {
            gradient[i] = plus_product::<FUSED>(alpha * a[i], beta, b[i]);
        }
        Self { value, gradient }
    }
}

/// a + b·c.
#[inline(always)]
fn plus_product<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FUSED { b.mul_add(c, a) } else { a + b * c }
}

impl<const N: usize, const FUSED: bool> Scalar for Dual<N, FUSED> {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self {
            value,
            gradient: [0.0; N],
        }
    }

    #[inline(always)]
    fn value(&self) -> f64 {
        self.value
    }

    #[inline(always)]
    fn chain(self, value: f64, first: f64, _second: f64) -> Self {
        self.scaled(value, first)
    }
}

impl<const N: usize, const FUSED: bool> Times<f64> for Dual<N, FUSED> {
    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        self * factor
    }

    #[inline(always)]
    fn plus_times(mut self, a: Self, factor: f64) -> Self {
        self.value = plus_product::<FUSED>(self.value, factor, a.value);
        for i in 0..N {
            self.gradient[i] = plus_product::<FUSED>(self.gradient[i], factor, a.gradient[i]);
        }
        self
    }

    #[inline(always)]
    fn minus_times(self, a: Self, factor: f64) -> Self {
        self.plus_times(a, -factor)
    }
}

impl<const N: usize, const FUSED: bool> Times<Self> for Dual<N, FUSED> {
    #[inline(always)]
    fn times(self, factor: Self) -> Self {
        self * factor
    }

    #[inline(always)]
    fn plus_times(mut self, a: Self, factor: Self) -> Self {
        self.value = plus_product::<FUSED>(self.value, a.value, factor.value);
        for i in 0..N {
            let half = plus_product::<FUSED>(self.gradient[i], a.value, factor.gradient[i]);
            self.gradient[i] = plus_product::<FUSED>(half, factor.value, a.gradient[i]);
        }
        self
    }

    #[inline(always)]
    fn minus_times(mut self, a: Self, factor: Self) -> Self {
        if !FUSED {
            return self - a * factor;
        }
        let (by_a, by_factor) = (-a.value, -factor.value);
        self.value = plus_product::<FUSED>(self.value, by_a, factor.value);
        for i in 0..N {
            let half = plus_product::<FUSED>(self.gradient[i], by_a, factor.gradient[i]);
            self.gradient[i] = plus_product::<FUSED>(half, by_factor, a.gradient[i]);
        }
        self
    }
}

impl<const N: usize, const FUSED: bool> Add for Dual<N, FUSED> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, rhs: Self) -> Self {
        self += rhs;
        self
    }
}

impl<const N: usize, const FUSED: bool> Sub for Dual<N, FUSED> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, rhs: Self) -> Self {
        self -= rhs;
        self
    }
}

impl<const N: usize, const FUSED: bool> Mul for Dual<N, FUSED> {
    type Output = Self;
    #[inline(always)]
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

impl<const N: usize, const FUSED: bool> Div for Dual<N, FUSED> {
    type Output = Self;
    #[inline(always)]
    fn div(self, rhs: Self) -> Self {
        let r = 1.0 / rhs.value;
        let quotient = self.value * r;
        Self::combine(quotient, r, &self.gradient, -quotient * r, &rhs.gradient)
    }
}

impl<const N: usize, const FUSED: bool> Neg for Dual<N, FUSED> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.scaled(-self.value, -1.0)
    }
}

impl<const N: usize, const FUSED: bool> AddAssign for Dual<N, FUSED> {
    #[inline(always)]
    fn add_assign(&mut self, rhs: Self) {
        self.value += rhs.value;
        for i in 0..N {
            self.gradient[i] += rhs.gradient[i];
        }
    }
}

impl<const N: usize, const FUSED: bool> SubAssign for Dual<N, FUSED> {
    #[inline(always)]
    fn sub_assign(&mut self, rhs: Self) {
        self.value -= rhs.value;
        for i in 0..N {
            self.gradient[i] -= rhs.gradient[i];
        }
    }
}

impl<const N: usize, const FUSED: bool> MulAssign for Dual<N, FUSED> {
    #[inline(always)]
    fn mul_assign(&mut self, rhs: Self) {
        *self = *self * rhs;
    }
}

impl<const N: usize, const FUSED: bool> Add<f64> for Dual<N, FUSED> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, rhs: f64) -> Self {
        self.value += rhs;
        self
    }
}

impl<const N: usize, const FUSED: bool> Sub<f64> for Dual<N, FUSED> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, rhs: f64) -> Self {
        self.value -= rhs;
        self
    }
}

impl<const N: usize, const FUSED: bool> Mul<f64> for Dual<N, FUSED> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, rhs: f64) -> Self {
        self.scaled(self.value * rhs, rhs)
    }
}

impl<const N: usize, const FUSED: bool> Div<f64> for Dual<N, FUSED> {
    type Output = Self;
    #[inline(always)]
    fn div(self, rhs: f64) -> Self {
        self.scaled(self.value / rhs, 1.0 / rhs)
    }
}

impl<const N: usize, const FUSED: bool> Zero for Dual<N, FUSED> {
    #[inline(always)]
    fn zero() -> Self {
        Self::constant(0.0)
    }

    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl<const N: usize, const FUSED: bool> One for Dual<N, FUSED> {
    #[inline(always)]
    fn one() -> Self {
        Self::constant(1.0)
    }
}
