//! What a monitor sees while a plan is made.

use crate::refine;

/// A step of planning, for a progress line; the monitor's answer can stop it.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub enum Event<'a> {
    /// A step of the refinement loop.
    Refinement(refine::Event<'a>),
    /// The start is far outside limits on the base: the next mesh is solved with these elastic.
    LeadingWithin,
    /// The diagnosis of an infeasible problem tries one more start.
    Diagnosing {
        /// Counted from 1.
        start: usize,
        /// Number of starts.
        of: usize,
    },
    /// A planner that works its way along the motion takes a step.
    Step {
        /// Counted from 1.
        step: usize,
        /// Number of steps.
        of: usize,
    },
}
