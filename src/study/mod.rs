//! Many plans for one question: one task by every planner, one task over its trade-off, one plan beside
//! the motion without planning.

mod baselines;
mod comparison;
pub mod pareto;

pub use baselines::{BaseMotion, Baselines, Gain, straight_to_end};
pub use comparison::{Comparison, Entry};
