//! What a monitor sees of a search.

use crate::planner::Event;

/// A step of a search, for a progress line; the monitor's answer can stop it.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub enum SearchEvent<'a> {
    /// A start was solved on the first mesh, or was not.
    Tried {
        /// How many were tried so far.
        tried: usize,
        /// Number of starts.
        of: usize,
        /// The least J until then, infinite where none was solved.
        best: f64,
    },
    /// A step of the refinement of one of the best.
    Refining {
        /// Which of them, counted from 1.
        candidate: usize,
        /// How many there are.
        of: usize,
        /// The step.
        event: Event<'a>,
    },
}

impl<'a> SearchEvent<'a> {
    /// A step of a plan that no search came before.
    pub(crate) fn of_plan(event: Event<'a>) -> Self {
        Self::Refining {
            candidate: 1,
            of: 1,
            event,
        }
    }
}
