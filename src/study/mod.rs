//! Many plans for one question: one task by every planner, one task over its trade-off.

mod comparison;
pub mod pareto;

pub use comparison::{Comparison, Entry};
