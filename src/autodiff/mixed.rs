//! Arithmetic of plain numbers with numbers that carry derivatives.

use super::{Dual, HyperDual, Scalar, Trace};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Sub, SubAssign};

/// A plain number as the left operand in code that is generic over [`Scalar`]: `Real(2.0) * x`.
///
/// The compiler lets no trait say for all implementors `S` that `f64: Mul<S>`. Where the type is
/// known, `2.0 * x` will do; on the right a plain `f64` always does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Real(pub f64);

impl<S: Scalar> Add<S> for Real {
    type Output = S;
    #[inline]
    fn add(self, rhs: S) -> S {
        rhs + self.0
    }
}

impl<S: Scalar> Sub<S> for Real {
    type Output = S;
    #[inline]
    fn sub(self, rhs: S) -> S {
        -rhs + self.0
    }
}

impl<S: Scalar> Mul<S> for Real {
    type Output = S;
    #[inline]
    fn mul(self, rhs: S) -> S {
        rhs * self.0
    }
}

impl<S: Scalar> Div<S> for Real {
    type Output = S;
    #[inline]
    fn div(self, rhs: S) -> S {
        S::constant(self.0) / rhs
    }
}

/// Operators between `f64` and a number type that has them with `f64` on the right.
macro_rules! mixed {
    ($number:ty $(, $parameter:ident: $kind:ty)*) => {
        mixed!(@left $number, Add add [$($parameter: $kind),*]);
        mixed!(@left $number, Sub sub [$($parameter: $kind),*]);
        mixed!(@left $number, Mul mul [$($parameter: $kind),*]);
        mixed!(@left $number, Div div [$($parameter: $kind),*]);
        mixed!(@assign $number, f64, AddAssign add_assign + [$($parameter: $kind),*]);
        mixed!(@assign $number, f64, SubAssign sub_assign - [$($parameter: $kind),*]);
        mixed!(@assign $number, f64, MulAssign mul_assign * [$($parameter: $kind),*]);
        mixed!(@assign $number, f64, DivAssign div_assign / [$($parameter: $kind),*]);
        mixed!(@assign $number, $number, DivAssign div_assign / [$($parameter: $kind),*]);
    };
    (@left $number:ty, $trait:ident $method:ident [$($parameter:ident: $kind:ty),*]) => {
        impl<$(const $parameter: $kind),*> $trait<$number> for f64 {
            type Output = $number;
            #[inline(always)]
            fn $method(self, rhs: $number) -> $number {
                $trait::$method(Real(self), rhs)
            }
        }
    };
    (
        @assign $number:ty, $rhs:ty, $trait:ident $method:ident $operator:tt
        [$($parameter:ident: $kind:ty),*]
    ) => {
        impl<$(const $parameter: $kind),*> $trait<$rhs> for $number {
            #[inline(always)]
            fn $method(&mut self, rhs: $rhs) {
                *self = *self $operator rhs;
            }
        }
    };
}

mixed!(Dual<N, FUSED>, N: usize, FUSED: bool);
mixed!(HyperDual<R, C>, R: usize, C: usize);
mixed!(Trace);
