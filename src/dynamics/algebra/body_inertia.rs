//! Spatial inertia of one body: from motions to momenta and forces.

use super::{Algebra, AngularMap, Coriolis, Force, Motion, Vector};
use crate::autodiff::Scalar;

/// Mass, mass centre about the base origin, and rotational inertia about that mass centre, in base
/// axes; constants at one configuration.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct BodyInertia<Sp: Algebra> {
    pub mass: f64,
    pub center: Sp::Linear<f64>,
    pub rotational: Sp::Inertia<f64>,
}

impl<Sp: Algebra> BodyInertia<Sp> {
    /// Velocity of the mass centre.
    #[inline(always)]
    pub fn center_velocity<S: Scalar>(&self, motion: &Motion<Sp, S>) -> Sp::Linear<S> {
        Sp::cross_constant(&motion.angular, &self.center).plus(&motion.linear)
    }

    /// Momentum I V of a motion whose velocity at the mass centre is `at_center`.
    #[inline(always)]
    pub fn momentum<S: Scalar>(
        &self,
        motion: &Motion<Sp, S>,
        at_center: &Sp::Linear<S>,
    ) -> Force<Sp, S> {
        let linear = at_center.times(self.mass);
        let angular = Sp::moment(&self.center, &linear);
        let own = Sp::apply_constant(&self.rotational, &motion.angular);
        Force::new(angular.plus(&own), linear)
    }

    /// Force I A + V ×* I V that gives the acceleration A (spatial, that is of the body's points as
    /// they pass the base origin) at the velocity V.
    #[inline(always)]
    pub fn force<S: Scalar>(
        &self,
        velocity: &Motion<Sp, S>,
        at_center: &Sp::Linear<S>,
        acceleration: &Motion<Sp, S>,
    ) -> Force<Sp, S> {
        let centripetal = Sp::cross(&velocity.angular, at_center);
        let linear = self.center_velocity(acceleration).plus(&centripetal);
        let linear = linear.times(self.mass);
        let own = Sp::apply_constant(&self.rotational, &acceleration.angular);
        let mut angular = Sp::moment(&self.center, &linear).plus(&own);
        if Sp::ANGLES > 1 {
            let spin = Sp::apply_constant(&self.rotational, &velocity.angular);
            angular = angular.plus(&Sp::cross_angular(&velocity.angular, &spin));
        }
        Force::new(angular, linear)
    }

    /// The body's share of the Coriolis forces at a velocity whose linear momentum is `momentum`.
    #[inline(always)]
    pub fn coriolis(&self, angular: &Sp::Angular<f64>, momentum: &Sp::Linear<f64>) -> Coriolis<Sp> {
        let moments = Sp::second_moments(&self.rotational);
        let spin = Sp::apply_constant(&self.rotational, angular);
        let moment = AngularMap::by_axes(|axis| {
            let linear = Sp::cross(axis, momentum);
            let moment = Sp::moment(&self.center, &linear).times(2.0);
            if Sp::ANGLES == 1 {
                return moment;
            }
            let crossed = Sp::cross_angular(angular, axis);
            moment
                .plus(&Sp::apply_constant(&moments, &crossed))
                .plus(&Sp::cross_angular(axis, &spin).times(2.0))
        });
        Coriolis {
            moment,
            momentum: *momentum,
        }
    }

    /// The matrix of the power on the motion `other`, whose velocity of the mass centre is
    /// `at_center`, of the Coriolis force in two angular velocities: of the body, and of its change.
    #[inline(always)]
    pub fn curvature(
        &self,
        other: &Motion<Sp, f64>,
        at_center: &Sp::Linear<f64>,
    ) -> AngularMap<Sp> {
        let moments = Sp::second_moments(&self.rotational);
        let weighted = Sp::apply_constant(&moments, &other.angular);
        AngularMap::by_axes(|axis| {
            let carried = Sp::cross(axis, &self.center);
            let power = Sp::moment(&carried, at_center).times(2.0 * self.mass);
            if Sp::ANGLES == 1 {
                return power;
            }
            let spin = Sp::apply_constant(&self.rotational, axis);
            power
                .plus(&Sp::cross_angular(&weighted, axis))
                .plus(&Sp::cross_angular(&spin, &other.angular).times(2.0))
        })
    }
}
