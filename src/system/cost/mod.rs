//! The cost (14), term by term.

mod terms;

pub use terms::{CostTerms, JointEffort};
