//! Planners that choose the joints' motion by a law of its own; the base follows by momentum.

pub(super) mod acceleration_qp;
mod joint_motion;
pub(super) mod matpm;
pub(super) mod reaction_null_space;
pub(super) mod straight_line;

pub use matpm::poses as matpm_motion;
