//! A vector with components of any number type.

use crate::autodiff::{Scalar, Times};
use nalgebra::{ArrayStorage, SVector};
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Sub, SubAssign};

/// A vector with components of type `S`.
///
/// Its methods are inlined, so that they are compiled for the vector instructions of whoever calls
/// them; the operators need not be.
pub trait Vector<S: Scalar>:
    Copy + Debug + Send + Sync + Add<Output = Self> + Sub<Output = Self> + AddAssign + SubAssign
{
    /// The zero vector.
    fn zero() -> Self;
    /// From its components, which may be more than it has.
    fn from_components(components: &[S]) -> Self;
    /// Inner product.
    fn dot(&self, other: &Self) -> S;
    /// Components.
    fn components(&self) -> &[S];
    /// Components, to be changed.
    fn components_mut(&mut self) -> &mut [S];

    /// Every component times `factor`.
    #[inline(always)]
    fn scaled(mut self, factor: S) -> Self {
        for c in self.components_mut() {
            *c *= factor;
        }
        self
    }

    /// Every component times a constant.
    #[inline(always)]
    fn times(mut self, factor: f64) -> Self {
        for c in self.components_mut() {
            *c *= factor;
        }
        self
    }

    /// self + other.
    #[inline(always)]
    fn plus(mut self, other: &Self) -> Self {
        for (a, &b) in self.components_mut().iter_mut().zip(other.components()) {
            *a += b;
        }
        self
    }

    /// self − other.
    #[inline(always)]
    fn minus(mut self, other: &Self) -> Self {
        for (a, &b) in self.components_mut().iter_mut().zip(other.components()) {
            *a -= b;
        }
        self
    }

    /// self + factor·other.
    #[inline(always)]
    fn plus_times<K: Copy>(mut self, other: &Self, factor: K) -> Self
    where
        S: Times<K>,
    {
        for (a, &b) in self.components_mut().iter_mut().zip(other.components()) {
            *a = a.plus_times(b, factor);
        }
        self
    }
}

impl<S: Scalar, const N: usize> Vector<S> for SVector<S, N> {
    #[inline(always)]
    fn zero() -> Self {
        vector([S::zero(); N])
    }
    #[inline(always)]
    fn from_components(components: &[S]) -> Self {
        let mut vector = <Self as Vector<S>>::zero();
        vector.components_mut().copy_from_slice(&components[..N]);
        vector
    }
    #[inline(always)]
    fn dot(&self, other: &Self) -> S {
        let (a, b) = (self.components(), other.components());
        let mut sum = a[0] * b[0];
        for i in 1..N {
            sum += a[i] * b[i];
        }
        sum
    }
    #[inline(always)]
    fn components(&self) -> &[S] {
        &self.data.0[0]
    }
    #[inline(always)]
    fn components_mut(&mut self) -> &mut [S] {
        &mut self.data.0[0]
    }
}

/// The vector of these components.
#[inline(always)]
pub(super) fn vector<S, const N: usize>(components: [S; N]) -> SVector<S, N> {
    SVector::from_array_storage(ArrayStorage([components]))
}

/// sum + Σ aᵢ·bᵢ.
#[inline(always)]
pub(in crate::dynamics) fn plus_inner<K: Copy, S: Times<K>>(mut sum: S, a: &[S], b: &[K]) -> S {
    for (&a, &b) in a.iter().zip(b) {
        sum = sum.plus_times(a, b);
    }
    sum
}
