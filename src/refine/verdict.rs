//! Whether the solution on a mesh counts, and if not, why.

use crate::nlp::Status;
use std::fmt;

/// What the solution on one mesh is worth: the first condition that it fails, or none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Verdict {
    /// The programme is solved, the largest error (28) is within the tolerance, and no bound is far
    /// exceeded between the nodes.
    Converged,
    /// The solver ended without a solution.
    NotSolved(Status),
    /// The rates or a bounded path row are not a number somewhere between the nodes.
    Undefined,
    /// The largest error (28) is above the tolerance.
    AboveTolerance,
    /// A bound is far exceeded between the nodes.
    BoundExceeded,
    /// Cost and error grow as the mesh gets finer: what solves the programme on each mesh is no
    /// approximation of a motion.
    Diverging,
}

impl Verdict {
    /// Whether all conditions are met.
    pub fn is_converged(self) -> bool {
        self == Self::Converged
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Converged => "converged",
            Self::NotSolved(status) => return write!(f, "{}", status.describe()),
            Self::Undefined => {
                "the problem's functions are not a number somewhere between the points of the mesh"
            }
            Self::AboveTolerance => "the tolerance is not reached",
            Self::Diverging => "cost and error grow as the mesh gets finer",
            Self::BoundExceeded => "a limit is far exceeded between the points of the mesh",
        })
    }
}
