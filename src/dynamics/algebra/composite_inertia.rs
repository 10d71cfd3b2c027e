//! Inertia of several bodies moving as one.

use super::{Algebra, BodyInertia, Force, Motion, Vector};
use crate::autodiff::Scalar;

/// Mass, first moment of mass and inertia, both about the base origin and in base axes.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct CompositeInertia<Sp: Algebra> {
    pub mass: f64,
    pub moment: Sp::Linear<f64>,
    pub inertia: Sp::Inertia<f64>,
}

impl<Sp: Algebra> CompositeInertia<Sp> {
    /// Of one body.
    #[inline(always)]
    pub fn of(body: &BodyInertia<Sp>) -> Self {
        Self {
            mass: body.mass,
            moment: body.center.times(body.mass),
            inertia: Sp::with_point_mass(&body.rotational, body.mass, &body.center),
        }
    }

    /// Adds further bodies.
    #[inline(always)]
    pub fn add(&mut self, other: &Self) {
        self.mass += other.mass;
        self.moment = self.moment.plus(&other.moment);
        self.inertia = Sp::sum(&self.inertia, &other.inertia);
    }

    /// Momentum of a motion of all of them.
    #[inline(always)]
    pub fn momentum<S: Scalar>(&self, motion: &Motion<Sp, S>) -> Force<Sp, S> {
        let linear = motion.linear.times(self.mass);
        let linear = linear.plus(&Sp::cross_constant(&motion.angular, &self.moment));
        let angular = Sp::apply_constant(&self.inertia, &motion.angular);
        let angular = angular.plus(&Sp::moment(&self.moment, &motion.linear));
        Force::new(angular, linear)
    }
}
