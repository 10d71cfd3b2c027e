//! An independent hyper-dual number, of the `num-dual` crate.

use ffsm_ipopt::autodiff::{Scalar, Times};
use num_dual::{DualNum, HyperDual64};
use num_traits::{One, Zero};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A `num-dual` number as a [`Scalar`]: arithmetic and functions are all its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference(pub HyperDual64);

macro_rules! operators {
    ($($trait:ident $method:ident $assign_trait:ident $assign:ident),*) => {$(
        impl $trait for Reference {
            type Output = Self;
            fn $method(self, rhs: Self) -> Self { Self($trait::$method(self.0, rhs.0)) }
        }
        impl $trait<f64> for Reference {
            type Output = Self;
            fn $method(self, rhs: f64) -> Self {
                Self($trait::$method(self.0, HyperDual64::from_re(rhs)))
            }
        }
        impl $assign_trait for Reference {
            fn $assign(&mut self, rhs: Self) { *self = $trait::$method(*self, rhs); }
        }
        impl $assign_trait<f64> for Reference {
            fn $assign(&mut self, rhs: f64) { *self = $trait::$method(*self, rhs); }
        }
    )*};
}

operators!(
    Add add AddAssign add_assign,
    Sub sub SubAssign sub_assign,
    Mul mul MulAssign mul_assign,
    Div div DivAssign div_assign
);

impl Times<f64> for Reference {
    fn times(self, factor: f64) -> Self {
        self * factor
    }
}

impl Times<Self> for Reference {
    fn times(self, factor: Self) -> Self {
        self * factor
    }
}

impl Neg for Reference {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Zero for Reference {
    fn zero() -> Self {
        Self::constant(0.0)
    }
    fn is_zero(&self) -> bool {
        self.0.re == 0.0
    }
}

impl One for Reference {
    fn one() -> Self {
        Self::constant(1.0)
    }
}

impl Scalar for Reference {
    fn constant(value: f64) -> Self {
        Self(HyperDual64::from_re(value))
    }
    fn value(&self) -> f64 {
        self.0.re
    }
    fn chain(self, value: f64, first: f64, second: f64) -> Self {
        let HyperDual64 {
            eps1,
            eps2,
            eps1eps2,
            ..
        } = self.0;
        let both = first * eps1eps2 + second * eps1 * eps2;
        Self(HyperDual64::new(value, first * eps1, first * eps2, both))
    }
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.0.sin_cos();
        (Self(s), Self(c))
    }
    fn recip(self) -> Self {
        Self(self.0.recip())
    }
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
}
