//! Why the published case has no solution, three ways.
//!
//! The curvature of the momentum connection says how little a detour of the joints can turn the
//! base; dynamic programming on a grid of joint angles says what no motion can do better than;
//! optimal control from many starts says what a motion does reach.

mod reach;
mod report;

pub use reach::{Reached, nearest_final_attitude};
pub use report::{Bounds, bounded, bounds, markdown};
