//! Spatial inertia of one body: from motions to momenta and forces.

use super::{Algebra, Force, Motion, Vector};
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

    /// V ×* I Y − Y ×* I V − I(V × Y) of two motions: a pure couple,
    /// (tr J·1 − 2J)(ω × υ) + 2m·v_c × y_c.
    #[inline(always)]
    pub fn couple<S: Scalar>(
        &self,
        (velocity, v_center): (&Motion<Sp, S>, &Sp::Linear<S>),
        (other, y_center): (&Motion<Sp, S>, &Sp::Linear<S>),
    ) -> Sp::Angular<S> {
        let couple = Sp::moment(v_center, y_center).times(2.0 * self.mass);
        if Sp::ANGLES == 1 {
            return couple;
        }
        let crossed = Sp::cross_angular(&velocity.angular, &other.angular);
        let moments = Sp::second_moments(&self.rotational);
        couple.plus(&Sp::apply_constant(&moments, &crossed))
    }
}
