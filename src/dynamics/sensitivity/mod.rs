//! First and second derivatives of the free motion by the structure of the recursions.
//!
//! The joint accelerations q̈ = −H⁻¹Cθ̇ are those at which one inverse-dynamics pass over the whole
//! robot, base included, needs no force anywhere. That pass is all that is differentiated:
//!
//! - First order: with base motion and accelerations held, dual numbers carry the pass; its
//!   residual and the factors of H give their derivatives (`first`). Nothing is differentiated
//!   through a factorisation.
//! - Second order: the residual weighted with multipliers is a scalar, of which a hand-written
//!   adjoint has the gradient (`second`). One sweep of dual numbers through it, seeded with the
//!   first derivatives, gives the whole Hessian.
//!
//! Derivatives of whatever belongs to a body are those seen from that body: its axis, its inertia
//! and all it carries stay as they are, and only the step from a body to the next adds a term, to
//! the one direction that is its joint's position: −S × motion outwards, S ×* force inwards. So all
//! positions stay plain numbers, and dual numbers are multiplied by them.
//!
//! Derived in docs/algorithms.md#first-derivatives-of-the-free-motion and
//! docs/algorithms.md#second-derivatives-of-the-free-motion.

mod configuration;
mod first;
mod free_motion;
mod second;
mod torque;
mod workspace;

pub use free_motion::Sensitivity;
