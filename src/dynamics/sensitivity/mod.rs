//! First and second derivatives of the free motion by the structure of the recursions.
//!
//! The joint accelerations q̈ = −H⁻¹Cθ̇ are those at which one inverse-dynamics pass over the whole
//! robot, base included, needs no force anywhere. That pass is all that is differentiated:
//!
//! - First order (`first`): with base motion and accelerations held, the change of the pass's
//!   residual and the factors of H give their derivatives. Nothing is differentiated through a
//!   factorisation.
//! - Second order (`second`): the residual weighted with multipliers is a scalar, the power of the
//!   forces in a virtual motion, whose second derivatives and the first ones of the motion give the
//!   whole Hessian.
//!
//! Derivatives of whatever belongs to a body are those seen from that body: its axis, its inertia
//! and all it carries stay as they are. What a joint changes is then the same for all bodies that it
//! carries, so that every derivative is a product with a sum over those: mass, forces, momenta.
//! Dual numbers, with as many directions at a time as vectors hold, carry what follows for base and
//! accelerations.
//!
//! Derived in docs/algorithms.md#first-derivatives-of-the-free-motion and
//! docs/algorithms.md#second-derivatives-of-the-free-motion.

mod configuration;
mod directions;
mod first;
mod free_motion;
mod kept;
mod second;
mod torque;
mod workspace;

pub use free_motion::Sensitivity;
