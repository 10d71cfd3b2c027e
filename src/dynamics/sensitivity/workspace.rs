//! Intermediate results at one point.

use crate::autodiff::Dual;
use crate::dynamics::Storage;
use crate::dynamics::algebra::{Algebra, AngularMap, Coriolis, Force, Motion, Vector};

/// How the motion of base and joints changes in the directions of one sweep.
#[derive(Debug)]
pub(super) struct Tangent<Sp: Algebra, J: Storage, const N: usize, const FUSED: bool> {
    /// Of the base.
    pub velocity: Motion<Sp, Dual<N, FUSED>>,
    /// The part of the bodies' accelerations that is common to all, Γ of [`JointStep`]; only its
    /// derivatives are of meaning.
    pub acceleration: Motion<Sp, Dual<N, FUSED>>,
    /// Of the joints' accelerations.
    pub joints: J::Array<Dual<N, FUSED>>,
}

/// The free motion of every body, and sums over the bodies that each joint carries.
#[derive(Debug)]
pub(super) struct Carried<Sp: Algebra, J: Storage> {
    pub velocity: J::Array<Motion<Sp, f64>>,
    pub acceleration: J::Array<Motion<Sp, f64>>,
    pub momentum: J::Array<Force<Sp, f64>>,
    pub force: J::Array<Force<Sp, f64>>,
    pub coriolis: J::Array<Coriolis<Sp>>,
    /// Of the whole robot.
    pub whole: Coriolis<Sp>,
}

impl<Sp: Algebra, J: Storage> Carried<Sp, J> {
    pub fn new(n: usize) -> Self {
        Self {
            velocity: J::array(Motion::zero(), n),
            acceleration: J::array(Motion::zero(), n),
            momentum: J::array(Force::zero(), n),
            force: J::array(Force::zero(), n),
            coriolis: J::array(Coriolis::zero(), n),
            whole: Coriolis::zero(),
        }
    }
}

/// What the position and the rate of one joint change in all the bodies that it carries.
///
/// As each body sees it, its velocity V changes by Φ and its acceleration by Γ − V × Φ, with Φ and
/// Γ the same for all of them.
#[derive(Debug, Clone)]
pub(super) struct JointStep<Sp: Algebra> {
    /// Φ by position; that by rate is the joint's axis S.
    pub velocity: Motion<Sp, f64>,
    /// Γ by position and by rate.
    pub acceleration: [Motion<Sp, f64>; 2],
    /// Change of their force by position and by rate, as the carrier sees it.
    pub force: [Force<Sp, f64>; 2],
    /// Change of their momentum by position and by rate, as the carrier sees it; that by rate, I·S,
    /// is also what an acceleration Γ weighs in the joint's force.
    pub momentum: [Force<Sp, f64>; 2],
    /// What a change Φ weighs in the joint's force.
    pub coriolis: Sp::Angular<f64>,
}

impl<Sp: Algebra> JointStep<Sp> {
    pub fn zero() -> Self {
        Self {
            velocity: Motion::zero(),
            acceleration: [Motion::zero(); 2],
            force: [Force::zero(); 2],
            momentum: [Force::zero(); 2],
            coriolis: Sp::Angular::<f64>::zero(),
        }
    }
}

/// What the multipliers make of the motion.
#[derive(Debug)]
pub(super) struct Adjoint<Sp: Algebra, J: Storage> {
    /// Multipliers of the joints' residuals: rates of a virtual motion without momentum.
    pub rates: J::Array<f64>,
    /// The motion, rigid about the mass centre, whose momentum the base's own rate is weighted
    /// with.
    pub rigid: Motion<Sp, f64>,
    pub virtual_motion: J::Array<Motion<Sp, f64>>,
    /// Sums over the bodies that each joint carries: momentum of the virtual motion, what a change
    /// of their velocity weighs, and the matrix of how two such changes weigh together.
    pub virtual_momentum: J::Array<Force<Sp, f64>>,
    pub weight: J::Array<Sp::Angular<f64>>,
    pub curvature: J::Array<AngularMap<Sp>>,
    pub gradient: J::Array<JointGradient<Sp>>,
    /// By rows: second derivatives by the position of the row's joint and the acceleration of the
    /// column's; zero where neither joint carries the other.
    pub by_accelerations: J::Array<J::Array<f64>>,
}

/// How the change by one joint of the bodies that it carries changes the weights of further
/// changes.
#[derive(Debug, Clone)]
pub(super) struct JointGradient<Sp: Algebra> {
    /// Change of the virtual motion and of the rigid one by position.
    pub virtual_motion: Motion<Sp, f64>,
    pub rigid: Motion<Sp, f64>,
    /// What Γ weighs, by position.
    pub acceleration: Force<Sp, f64>,
    /// What Φ weighs, by position and, its angular part alone, by rate.
    pub velocity: Force<Sp, f64>,
    pub velocity_by_rate: Sp::Angular<f64>,
}

impl<Sp: Algebra, J: Storage> Adjoint<Sp, J> {
    pub fn new(n: usize) -> Self {
        let gradient = JointGradient {
            virtual_motion: Motion::zero(),
            rigid: Motion::zero(),
            acceleration: Force::zero(),
            velocity: Force::zero(),
            velocity_by_rate: Sp::Angular::<f64>::zero(),
        };
        Self {
            rates: J::array(0.0, n),
            rigid: Motion::zero(),
            virtual_motion: J::array(Motion::zero(), n),
            virtual_momentum: J::array(Force::zero(), n),
            weight: J::array(Sp::Angular::<f64>::zero(), n),
            curvature: J::array(AngularMap::zero(), n),
            gradient: J::array(gradient, n),
            by_accelerations: J::array(J::array(0.0, n), n),
        }
    }
}

/// A motion without momentum, and its derivatives by the joint positions at fixed joint rates.
#[derive(Debug)]
pub(super) struct Field<Sp: Algebra, J: Storage> {
    pub motion: J::Array<Motion<Sp, f64>>,
    /// Of the bodies that each joint carries.
    pub momentum: J::Array<Force<Sp, f64>>,
    /// Change of the motion of those bodies as they see it, and of their momentum as the carrier
    /// does, by the joint's position.
    pub motion_by: J::Array<Motion<Sp, f64>>,
    pub momentum_by: J::Array<Force<Sp, f64>>,
}

impl<Sp: Algebra, J: Storage> Field<Sp, J> {
    pub fn new(n: usize) -> Self {
        Self {
            motion: J::array(Motion::zero(), n),
            momentum: J::array(Force::zero(), n),
            motion_by: J::array(Motion::zero(), n),
            momentum_by: J::array(Force::zero(), n),
        }
    }
}
