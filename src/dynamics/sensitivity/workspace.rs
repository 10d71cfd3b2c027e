//! Intermediate results of one sweep.

use crate::autodiff::{Dual, Scalar};
use crate::dynamics::algebra::{Algebra, Force, Motion};

/// Place of a direction in the sweep of `N` that starts at direction `start`.
#[inline(always)]
pub(super) fn in_sweep<const N: usize>(start: usize, direction: usize) -> Option<usize> {
    direction.checked_sub(start).filter(|&place| place < N)
}

/// Base motion and accelerations with their derivatives in the directions of one sweep.
#[derive(Debug)]
pub(super) struct Tangent<Sp: Algebra, const N: usize, const FUSED: bool> {
    pub velocity: Motion<Sp, Dual<N, FUSED>>,
    pub acceleration: Motion<Sp, Dual<N, FUSED>>,
    pub joints: Vec<Dual<N, FUSED>>,
}

/// Motions and forces of the bodies.
#[derive(Debug)]
pub(super) struct Passes<Sp: Algebra, S: Scalar> {
    pub velocity: Vec<Motion<Sp, S>>,
    pub acceleration: Vec<Motion<Sp, S>>,
    pub force: Vec<Force<Sp, S>>,
    pub residual: Vec<S>,
}

/// What the adjoint carries beside the motions and forces of the first pass.
#[derive(Debug)]
pub(super) struct Adjoint<Sp: Algebra, S: Scalar> {
    /// Multipliers of the joints' residuals: rates of a virtual motion without momentum.
    pub rates: Vec<f64>,
    pub virtual_motion: Vec<Motion<Sp, S>>,
    /// Its momentum.
    pub virtual_momentum: Vec<Force<Sp, S>>,
    /// axis × velocity.
    pub across: Vec<Motion<Sp, S>>,
    /// What the velocity of each body weighs.
    pub weight: Vec<Force<Sp, S>>,
    pub momentum: Vec<Force<Sp, S>>,
    /// The motion whose momentum the base's own rate is weighted with.
    pub rigid: Vec<Motion<Sp, S>>,
    /// Gradient by θ and θ̇, then by base motion, base acceleration and joint accelerations.
    pub direct: Vec<S>,
    pub implied: Vec<S>,
}

impl<Sp: Algebra, S: Scalar> Adjoint<Sp, S> {
    pub fn new(n: usize) -> Self {
        let motions = vec![Motion::zero(); n];
        let forces = vec![Force::zero(); n];
        let components = 2 * (Sp::ANGLES + Sp::LENGTHS);
        Self {
            rates: vec![0.0; n],
            virtual_motion: motions.clone(),
            virtual_momentum: forces.clone(),
            across: motions.clone(),
            weight: forces.clone(),
            momentum: forces,
            rigid: motions,
            direct: vec![S::zero(); 2 * n],
            implied: vec![S::zero(); components + n],
        }
    }
}

/// Momentum-free motions, of the controls and of the weights, and their momenta.
#[derive(Debug)]
pub(super) struct TorqueFields<Sp: Algebra, S: Scalar> {
    pub motion: [Vec<Motion<Sp, S>>; 2],
    pub momentum: [Vec<Force<Sp, S>>; 2],
    /// Change of the base's motion of the controls, by sweeps.
    pub base: Vec<Motion<Sp, S>>,
    pub row: Vec<S>,
}

impl<Sp: Algebra, S: Scalar> TorqueFields<Sp, S> {
    pub fn new(n: usize, sweeps: usize) -> Self {
        let motions = || vec![Motion::zero(); n];
        let forces = || vec![Force::zero(); n];
        Self {
            motion: [motions(), motions()],
            momentum: [forces(), forces()],
            base: vec![Motion::zero(); sweeps],
            row: vec![S::zero(); n],
        }
    }
}
