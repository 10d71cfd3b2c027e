//! Motions and forces of rigid bodies: an angular and a linear part, about the base origin in base
//! axes.
//!
//! Everything is inlined, so that it is compiled for the vector instructions of whoever calls it.

use super::{Algebra, Vector, plus_inner};
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

    /// Hands the components to `visit`.
    #[inline(always)]
    pub fn visit(&mut self, visit: &mut impl FnMut(&mut [S])) {
        visit(self.angular.components_mut());
        visit(self.linear.components_mut());
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
        let (a, b) = (self.angular.components(), other.angular.components());
        let angular = plus_inner(a[0].times(b[0]), &a[1..], &b[1..]);
        plus_inner(angular, self.linear.components(), other.linear.components())
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

impl<Sp: Algebra, const N: usize, const FUSED: bool, D: Side> SpatialVector<Sp, Dual<N, FUSED>, D> {
    /// The derivatives times `factor`, about another value.
    #[inline(always)]
    pub fn derivatives(mut self, value: &SpatialVector<Sp, f64, D>, factor: f64) -> Self {
        self.each(value, |c, &value| {
            *c *= factor;
            c.value = value;
        });
        self
    }

    /// Adds `factor`·`constant`.
    #[inline(always)]
    pub fn add_constant_times(
        &mut self,
        constant: &SpatialVector<Sp, f64, D>,
        factor: Dual<N, FUSED>,
    ) {
        self.each(constant, |to, &by| *to = to.plus_times(factor, by));
    }

    /// Adds `by` to the derivative in `direction`.
    #[inline(always)]
    pub fn add_derivative(&mut self, direction: usize, by: &SpatialVector<Sp, f64, D>) {
        self.each(by, |to, &by| to.add_derivative(direction, by));
    }

    /// Each component with that of a constant.
    #[inline(always)]
    fn each(
        &mut self,
        constant: &SpatialVector<Sp, f64, D>,
        mut change: impl FnMut(&mut Dual<N, FUSED>, &f64),
    ) {
        let (angular, linear) = (&constant.angular, &constant.linear);
        for (c, constant) in self
            .angular
            .components_mut()
            .iter_mut()
            .zip(angular.components())
        {
            change(c, constant);
        }
        for (c, constant) in self
            .linear
            .components_mut()
            .iter_mut()
            .zip(linear.components())
        {
            change(c, constant);
        }
    }
}
