//! Second-order dual numbers that carry one rectangular block of the Hessian.

// The product and quotient rules are sums and products.
#![allow(clippy::suspicious_arithmetic_impl)]

use super::{Scalar, Times};
use num_traits::{One, Zero};
use std::array::from_fn;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A value with first derivatives in `R` row and `C` column directions and the R×C block of
/// second derivatives across them: v + Σ rᵢεᵢ + Σ cⱼδⱼ + Σ bᵢⱼεᵢδⱼ, εᵢεₖ = δⱼδₖ = 0.
///
/// A full Hessian is swept block by block, and a block known to be zero is left out. A diagonal
/// block uses the same variables as rows and as columns.
///
/// See J. A. Fike and J. J. Alonso, "The development of hyper-dual numbers for exact
/// second-derivative calculations", doi:10.2514/6.2011-886.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HyperDual<const R: usize, const C: usize> {
    /// The value v.
    pub value: f64,
    /// First derivatives rᵢ in the row directions.
    pub rows: [f64; R],
    /// First derivatives cⱼ in the column directions.
    pub columns: [f64; C],
    /// Second derivatives bᵢⱼ.
    pub block: [[f64; C]; R],
}

impl<const R: usize, const C: usize> HyperDual<R, C> {
    /// A variable that is row direction `row` and column direction `column`, where given.
    #[inline]
    pub fn seeded(value: f64, row: Option<usize>, column: Option<usize>) -> Self {
        let mut seeded = Self::constant(value);
        if let Some(row) = row {
            seeded.rows[row] = 1.0;
        }
        if let Some(column) = column {
            seeded.columns[column] = 1.0;
        }
        seeded
    }

    #[inline]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self {
            value: f(self.value),
            rows: self.rows.map(&f),
            columns: self.columns.map(&f),
            block: self.block.map(|row| row.map(&f)),
        }
    }

    #[inline]
    fn zip(self, rhs: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            value: f(self.value, rhs.value),
            rows: from_fn(|i| f(self.rows[i], rhs.rows[i])),
            columns: from_fn(|j| f(self.columns[j], rhs.columns[j])),
            block: from_fn(|i| from_fn(|j| f(self.block[i][j], rhs.block[i][j]))),
        }
    }
}

impl<const R: usize, const C: usize> Scalar for HyperDual<R, C> {
    #[inline]
    fn constant(value: f64) -> Self {
        Self {
            value,
            rows: [0.0; R],
            columns: [0.0; C],
            block: [[0.0; C]; R],
        }
    }

    #[inline]
    fn value(&self) -> f64 {
        self.value
    }

    #[inline]
    fn chain(self, value: f64, first: f64, second: f64) -> Self {
        Self {
            value,
            rows: self.rows.map(|r| first * r),
            columns: self.columns.map(|c| first * c),
            block: from_fn(|i| {
                let curved = second * self.rows[i];
                from_fn(|j| first * self.block[i][j] + curved * self.columns[j])
            }),
        }
    }
}

impl<const R: usize, const C: usize> Times<f64> for HyperDual<R, C> {
    #[inline]
    fn times(self, factor: f64) -> Self {
        self * factor
    }
}

impl<const R: usize, const C: usize> Times<Self> for HyperDual<R, C> {
    #[inline]
    fn times(self, factor: Self) -> Self {
        factor * self
    }
}

impl<const R: usize, const C: usize> Add for HyperDual<R, C> {
    type Output = Self;
    #[inline]
    fn add(self, rhs: Self) -> Self {
        self.zip(rhs, |a, b| a + b)
    }
}

impl<const R: usize, const C: usize> Sub for HyperDual<R, C> {
    type Output = Self;
    #[inline]
    fn sub(self, rhs: Self) -> Self {
        self.zip(rhs, |a, b| a - b)
    }
}

impl<const R: usize, const C: usize> Mul for HyperDual<R, C> {
    type Output = Self;
    #[inline]
    fn mul(self, rhs: Self) -> Self {
        let (a, b) = (self.value, rhs.value);
        Self {
            value: a * b,
            rows: from_fn(|i| a * rhs.rows[i] + b * self.rows[i]),
            columns: from_fn(|j| a * rhs.columns[j] + b * self.columns[j]),
            block: from_fn(|i| {
                from_fn(|j| {
                    a * rhs.block[i][j]
                        + b * self.block[i][j]
                        + self.rows[i] * rhs.columns[j]
                        + rhs.rows[i] * self.columns[j]
                })
            }),
        }
    }
}

impl<const R: usize, const C: usize> Div for HyperDual<R, C> {
    type Output = Self;
    #[inline]
    fn div(self, rhs: Self) -> Self {
        self * rhs.recip()
    }
}

impl<const R: usize, const C: usize> Neg for HyperDual<R, C> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self.map(|a| -a)
    }
}

impl<const R: usize, const C: usize> AddAssign for HyperDual<R, C> {
    #[inline]
    fn add_assign(&mut self, rhs: Self) {
        *self = *self + rhs;
    }
}

impl<const R: usize, const C: usize> SubAssign for HyperDual<R, C> {
    #[inline]
    fn sub_assign(&mut self, rhs: Self) {
        *self = *self - rhs;
    }
}

impl<const R: usize, const C: usize> MulAssign for HyperDual<R, C> {
    #[inline]
    fn mul_assign(&mut self, rhs: Self) {
        *self = *self * rhs;
    }
}

impl<const R: usize, const C: usize> Add<f64> for HyperDual<R, C> {
    type Output = Self;
    #[inline]
    fn add(mut self, rhs: f64) -> Self {
        self.value += rhs;
        self
    }
}

impl<const R: usize, const C: usize> Sub<f64> for HyperDual<R, C> {
    type Output = Self;
    #[inline]
    fn sub(mut self, rhs: f64) -> Self {
        self.value -= rhs;
        self
    }
}

impl<const R: usize, const C: usize> Mul<f64> for HyperDual<R, C> {
    type Output = Self;
    #[inline]
    fn mul(self, rhs: f64) -> Self {
        self.map(|a| a * rhs)
    }
}

impl<const R: usize, const C: usize> Div<f64> for HyperDual<R, C> {
    type Output = Self;
    #[inline]
    fn div(self, rhs: f64) -> Self {
        self.map(|a| a / rhs)
    }
}

impl<const R: usize, const C: usize> Zero for HyperDual<R, C> {
    #[inline]
    fn zero() -> Self {
        Self::constant(0.0)
    }

    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl<const R: usize, const C: usize> One for HyperDual<R, C> {
    #[inline]
    fn one() -> Self {
        Self::constant(1.0)
    }
}
