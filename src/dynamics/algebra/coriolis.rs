//! How a velocity changes the forces that bodies need.

use super::{Algebra, AngularMap, Force, Motion, Vector};
use crate::autodiff::Scalar;

/// The map Φ ↦ V ×* IΦ + Φ ×* IV − I(V × Φ), summed over bodies with inertia I and velocity V.
///
/// Where the velocities of some bodies change by Φ and their accelerations by Γ − V × Φ, this and
/// IΓ are the change of their forces. Of Φ its angular part alone counts: a velocity common to all
/// points needs no force.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Coriolis<Sp: Algebra> {
    /// To the moment.
    pub moment: AngularMap<Sp>,
    /// Linear momentum of the bodies.
    pub momentum: Sp::Linear<f64>,
}

impl<Sp: Algebra> Coriolis<Sp> {
    #[inline(always)]
    pub fn zero() -> Self {
        Self {
            moment: AngularMap::zero(),
            momentum: Sp::Linear::<f64>::zero(),
        }
    }

    /// Adds further bodies.
    #[inline(always)]
    pub fn add(&mut self, other: &Self) {
        self.moment.add(&other.moment);
        self.momentum = self.momentum.plus(&other.momentum);
    }

    /// Hands the numbers to `visit`.
    #[inline(always)]
    pub fn visit(&mut self, visit: &mut impl FnMut(&mut [f64])) {
        self.moment.visit(visit);
        visit(self.momentum.components_mut());
    }

    /// The force that a change of the angular velocity adds.
    #[inline(always)]
    pub fn force<S: Scalar>(&self, angular: &Sp::Angular<S>) -> Force<Sp, S> {
        let linear = Sp::cross_constant(angular, &self.momentum).times(2.0);
        Force::new(self.moment.apply(angular), linear)
    }

    /// The transposed map: what the angular velocity weighs in the power of the forces on
    /// `motion`.
    #[inline(always)]
    pub fn weight(&self, motion: &Motion<Sp, f64>) -> Sp::Angular<f64> {
        let linear = Sp::moment(&self.momentum, &motion.linear).times(2.0);
        self.moment.apply_transposed(&motion.angular).plus(&linear)
    }
}
