//! What a monitor is told of a refinement.

use super::Record;
use crate::nlp::Progress;

/// A step of the loop, for a monitor.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub enum Event<'a> {
    /// A mesh iteration begins.
    Mesh {
        /// Counted from 1.
        iteration: usize,
        /// Number of segments.
        segments: usize,
        /// Number of collocation points.
        points: usize,
    },
    /// An iteration of the solver on the current mesh.
    Solver(&'a Progress),
    /// A mesh iteration ended.
    Solved(&'a Record),
}
