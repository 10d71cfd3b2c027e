//! A number that records how it was computed, for the structure of derivatives.

use super::tape::{Node, Operation, append, inspect, source};
use super::{Scalar, Times};
use num_traits::{One, Zero};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A value, and where it stands in the record of this thread; constants stand nowhere.
///
/// What is made of constants alone is a constant. A product with the constant zero is that
/// constant, a sum with it the other operand. Whether a quantity is zero by its value plays no
/// part: only the operations do. What an `if` on a value leaves out is not seen, but that the value
/// was asked for is; [`Scalar::max`], [`Scalar::min`] and [`Scalar::abs`] record all that may be.
///
/// A number belongs to the recording it was made in: with others it panics.
#[derive(Debug, Clone, Copy)]
pub struct Trace {
    value: f64,
    node: Option<Node>,
}

impl Trace {
    /// A variable, by its number among those that derivatives are taken by.
    pub(super) fn variable(number: usize, value: f64) -> Self {
        Self {
            value,
            node: Some(source(Operation::Variable(number))),
        }
    }

    /// A quantity that takes many values, though no derivative is taken by it.
    pub(super) fn parameter(value: f64) -> Self {
        Self {
            value,
            node: Some(source(Operation::Parameter)),
        }
    }

    /// Where it stands on its tape; `None` for a constant.
    pub(super) fn index(&self) -> Option<usize> {
        self.node.map(|node| node.index)
    }

    /// A function that may bend, with this value.
    fn bent(self, value: f64) -> Self {
        let node = self
            .node
            .map(|a| append([a], |[a]| Operation::Univariate(a)));
        Self { value, node }
    }

    /// Another value that is straight in this one.
    fn straight(self, value: f64) -> Self {
        Self { value, ..self }
    }

    /// A value that is straight in `self` and in `other`.
    fn linear(self, other: Self, value: f64) -> Self {
        let node = match (self.node, other.node) {
            (Some(a), Some(b)) if a != b => Some(append([a, b], |[a, b]| Operation::Linear(a, b))),
            (a, b) => a.or(b),
        };
        Self { value, node }
    }
}

impl Scalar for Trace {
    fn constant(value: f64) -> Self {
        Self { value, node: None }
    }

    /// Noted, unless it is a constant's: who asks may branch on it.
    fn value(&self) -> f64 {
        if self.node.is_some() {
            inspect();
        }
        self.value
    }

    /// Bends, whatever `first` and `second` are.
    fn chain(self, value: f64, _first: f64, _second: f64) -> Self {
        self.bent(value)
    }

    // The functions of all numbers again, without asking for the value.

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.bent(sin), self.bent(cos))
    }

    fn recip(self) -> Self {
        self.bent(self.value.recip())
    }

    fn sqrt(self) -> Self {
        self.bent(self.value.sqrt())
    }

    fn exp(self) -> Self {
        self.bent(self.value.exp())
    }

    fn ln(self) -> Self {
        self.bent(self.value.ln())
    }

    fn powi(self, power: i32) -> Self {
        match power {
            0 => Self::one(),
            1 => self,
            _ => self.bent(self.value.powi(power)),
        }
    }

    fn powf(self, power: f64) -> Self {
        if power == 0.0 {
            return Self::one();
        }
        if power == 1.0 {
            return self;
        }
        self.bent(self.value.powf(power))
    }

    fn tan(self) -> Self {
        self.bent(self.value.tan())
    }

    fn asin(self) -> Self {
        self.bent(self.value.asin())
    }

    fn atan(self) -> Self {
        self.bent(self.value.atan())
    }

    fn tanh(self) -> Self {
        self.bent(self.value.tanh())
    }

    /// Either of both.
    fn max(self, other: Self) -> Self {
        self.linear(other, Scalar::max(self.value, other.value))
    }

    /// Either of both.
    fn min(self, other: Self) -> Self {
        self.linear(other, Scalar::min(self.value, other.value))
    }

    /// Bends in both, wherever the point is.
    fn atan2(self, x: Self) -> Self {
        let angle = self.value.atan2(x.value);
        self.linear(x, angle).bent(angle)
    }

    fn abs(self) -> Self {
        self.straight(self.value.abs())
    }
}

impl PartialEq for Trace {
    /// Whether the values are the same, which is noted as [`value`](Scalar::value) is.
    fn eq(&self, other: &Self) -> bool {
        self.value() == other.value()
    }
}

impl Times<f64> for Trace {
    fn times(self, factor: f64) -> Self {
        self * factor
    }
}

impl Times<Self> for Trace {
    fn times(self, factor: Self) -> Self {
        self * factor
    }
}

impl Add for Trace {
    type Output = Self;
    fn add(self, rhs: Self) -> Self {
        self.linear(rhs, self.value + rhs.value)
    }
}

impl Sub for Trace {
    type Output = Self;
    fn sub(self, rhs: Self) -> Self {
        self.linear(rhs, self.value - rhs.value)
    }
}

impl Mul for Trace {
    type Output = Self;
    fn mul(self, rhs: Self) -> Self {
        match (self.node, rhs.node) {
            (_, None) => self * rhs.value,
            (None, _) => rhs * self.value,
            (Some(a), Some(b)) => Self {
                value: self.value * rhs.value,
                node: Some(append([a, b], |[a, b]| Operation::Product(a, b))),
            },
        }
    }
}

impl Div for Trace {
    type Output = Self;
    fn div(self, rhs: Self) -> Self {
        let value = self.value / rhs.value;
        match (self.node, rhs.node) {
            (_, None) => self.straight(value),
            (None, Some(_)) if self.value == 0.0 => Self::zero(),
            (None, Some(_)) => rhs.bent(value),
            (Some(a), Some(b)) => Self {
                value,
                node: Some(append([a, b], |[a, b]| Operation::Quotient(a, b))),
            },
        }
    }
}

impl Neg for Trace {
    type Output = Self;
    fn neg(self) -> Self {
        self.straight(-self.value)
    }
}

impl AddAssign for Trace {
    fn add_assign(&mut self, rhs: Self) {
        *self = *self + rhs;
    }
}

impl SubAssign for Trace {
    fn sub_assign(&mut self, rhs: Self) {
        *self = *self - rhs;
    }
}

impl MulAssign for Trace {
    fn mul_assign(&mut self, rhs: Self) {
        *self = *self * rhs;
    }
}

impl Add<f64> for Trace {
    type Output = Self;
    fn add(self, rhs: f64) -> Self {
        self.straight(self.value + rhs)
    }
}

impl Sub<f64> for Trace {
    type Output = Self;
    fn sub(self, rhs: f64) -> Self {
        self.straight(self.value - rhs)
    }
}

impl Mul<f64> for Trace {
    type Output = Self;
    fn mul(self, rhs: f64) -> Self {
        if rhs == 0.0 {
            Self::zero()
        } else {
            self.straight(self.value * rhs)
        }
    }
}

impl Div<f64> for Trace {
    type Output = Self;
    fn div(self, rhs: f64) -> Self {
        self.straight(self.value / rhs)
    }
}

impl Zero for Trace {
    fn zero() -> Self {
        Self::constant(0.0)
    }

    /// Whether it is the constant.
    fn is_zero(&self) -> bool {
        self.node.is_none() && self.value == 0.0
    }
}

impl One for Trace {
    fn one() -> Self {
        Self::constant(1.0)
    }
}
