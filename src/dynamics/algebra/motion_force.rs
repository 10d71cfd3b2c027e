//! Motions and forces of rigid bodies: an angular and a linear part, about the base origin in base
//! axes.
//!
//! Everything is inlined, so that it is compiled for the vector instructions of whoever calls it.

use super::{Algebra, Vector};
use crate::autodiff::{Dual, Scalar, Times};
use std::fmt::Debug;
use std::marker::PhantomData;

/// Which of two dual spaces a vector is in: their inner product is a power.
pub(in crate::dynamics) trait Side:
    Copy + Debug + Send + Sync + 'static
{
    type Dual: Side;
}

/// The space of motions.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct OfMotions;

/// The space of forces.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct OfForces;

impl Side for OfMotions {
    type Dual = OfForces;
}

impl Side for OfForces {
    type Dual = OfMotions;
}

/// Angular velocity, and linear velocity of the point of the body at the origin; or the
/// derivatives of both.
pub(in crate::dynamics) type Motion<Sp, S> = SpatialVector<Sp, S, OfMotions>;

/// Moment about the origin and force; or angular and linear momentum.
pub(in crate::dynamics) type Force<Sp, S> = SpatialVector<Sp, S, OfForces>;

/// A [`Motion`] or a [`Force`].
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct SpatialVector<Sp: Algebra, S: Scalar, D> {
    pub angular: Sp::Angular<S>,
    pub linear: Sp::Linear<S>,
    side: PhantomData<D>,
}

impl<Sp: Algebra, S: Scalar, D: Side> SpatialVector<Sp, S, D> {
    #[inline(always)]
    pub fn new(angular: Sp::Angular<S>, linear: Sp::Linear<S>) -> Self {
        Self {
            angular,
            linear,
            side: PhantomData,
        }
    }

    #[inline(always)]
    pub fn zero() -> Self {
        Self::new(Sp::Angular::zero(), Sp::Linear::zero())
    }

    /// All components, the angular ones first.
    #[inline(always)]
    pub fn iter(&self) -> impl Iterator<Item = &S> {
        let angular = self.angular.components();
        angular.iter().chain(self.linear.components())
    }

    #[inline(always)]
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut S> {
        let (angular, linear) = (&mut self.angular, &mut self.linear);
        let angular = angular.components_mut();
        angular.iter_mut().chain(linear.components_mut())
    }

    #[inline(always)]
    pub fn add(&mut self, other: &Self) {
        self.angular = self.angular.plus(&other.angular);
        self.linear = self.linear.plus(&other.linear);
    }

    /// Adds `factor`·other.
    #[inline(always)]
    pub fn add_times<K: Copy>(&mut self, other: &Self, factor: K)
    where
        S: Times<K>,
    {
        self.angular = self.angular.plus_times(&other.angular, factor);
        self.linear = self.linear.plus_times(&other.linear, factor);
    }

    /// Power of a force on a motion, in either order.
    #[inline(always)]
    pub fn dot<K: Scalar>(&self, other: &SpatialVector<Sp, K, D::Dual>) -> S
    where
        S: Times<K>,
    {
        let mut pairs = self.iter().zip(other.iter());
        let (&a, &b) = pairs.next().expect("a motion has components");
        let mut power = a.times(b);
        for (&a, &b) in pairs {
            power = power.plus_times(a, b);
        }
        power
    }
}

impl<Sp: Algebra, S: Scalar> Motion<Sp, S> {
    /// self × motion: how a motion that moves along with self changes.
    #[inline(always)]
    pub fn cross(&self, motion: &Self) -> Self {
        let linear = Sp::cross(&self.angular, &motion.linear);
        Self::new(
            Sp::cross_angular(&self.angular, &motion.angular),
            linear.minus(&Sp::cross(&motion.angular, &self.linear)),
        )
    }

    /// self ×* force: how a force that moves along with self changes.
    #[inline(always)]
    pub fn cross_force<T: Scalar + Times<S>>(&self, force: &Force<Sp, T>) -> Force<Sp, T> {
        let mut angular = Sp::moment(&self.linear, &force.linear);
        if Sp::ANGLES > 1 {
            angular = angular.plus(&Sp::cross_angular(&self.angular, &force.angular));
        }
        Force::new(angular, Sp::cross(&self.angular, &force.linear))
    }
}

impl<Sp: Algebra> Motion<Sp, f64> {
    /// self × motion for a constant self.
    #[inline(always)]
    pub fn constant_cross<S: Scalar>(&self, motion: &Motion<Sp, S>) -> Motion<Sp, S> {
        let linear = Sp::cross(&self.angular, &motion.linear);
        Motion::new(
            Sp::cross_angular(&self.angular, &motion.angular),
            linear.minus(&Sp::cross_constant(&motion.angular, &self.linear)),
        )
    }
}

impl<Sp: Algebra, D: Side> SpatialVector<Sp, f64, D> {
    /// A constant, as any number.
    #[inline(always)]
    pub fn lifted<S: Scalar>(&self) -> SpatialVector<Sp, S, D> {
        let mut lifted = SpatialVector::zero();
        for (to, &from) in lifted.iter_mut().zip(self.iter()) {
            *to = S::constant(from);
        }
        lifted
    }
}

impl<Sp: Algebra, const N: usize, const FUSED: bool, D: Side> SpatialVector<Sp, Dual<N, FUSED>, D> {
    /// The value without its derivatives.
    #[inline(always)]
    pub fn value(&self) -> SpatialVector<Sp, f64, D> {
        let mut value = SpatialVector::zero();
        for (to, from) in value.iter_mut().zip(self.iter()) {
            *to = from.value;
        }
        value
    }

    /// The derivatives times `factor`, about another value.
    #[inline(always)]
    pub fn derivatives(mut self, value: &SpatialVector<Sp, f64, D>, factor: f64) -> Self {
        for (c, &value) in self.iter_mut().zip(value.iter()) {
            *c *= factor;
            c.value = value;
        }
        self
    }

    /// Adds `factor`·`by` to the value.
    #[inline(always)]
    pub fn add_value(&mut self, by: &SpatialVector<Sp, f64, D>, factor: f64) {
        for (to, by) in self.iter_mut().zip(by.iter()) {
            to.value += factor * by;
        }
    }

    /// Adds `factor`·`constant`.
    #[inline(always)]
    pub fn add_constant_times(
        &mut self,
        constant: &SpatialVector<Sp, f64, D>,
        factor: Dual<N, FUSED>,
    ) {
        for (to, &by) in self.iter_mut().zip(constant.iter()) {
            *to = to.plus_times(factor, by);
        }
    }

    /// Adds `factor`·`by` to the derivative in `direction`, where there is one.
    #[inline(always)]
    pub fn add_derivative(
        &mut self,
        direction: Option<usize>,
        by: &SpatialVector<Sp, f64, D>,
        factor: f64,
    ) {
        if let Some(direction) = direction {
            for (to, by) in self.iter_mut().zip(by.iter()) {
                to.add_derivative(direction, factor * by);
            }
        }
    }
}
