//! Many plans for one question: one task by every planner, over its trade-off, from many starts.

mod comparison;
pub mod pareto;
pub mod search;

pub use comparison::{Comparison, Entry};
