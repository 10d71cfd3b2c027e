//! Many plans for one question: one task by every planner, over its trade-off, from many starts; many
//! tasks side by side; one plan beside the motion without planning, or under all that is uncertain.

mod baselines;
pub mod batch;
mod comparison;
pub mod dispersion;
pub mod pareto;
pub mod search;

pub use baselines::{BaseMotion, Baselines, Gain};
pub use comparison::{Comparison, Entry};
