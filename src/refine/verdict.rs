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
    /// The same, but for an instant (less than a thousandth of the duration) a control, or a row of
    /// the controls, exceeds a bound by more than a tenth of its size between the nodes.
    Overshoots,
    /// The solver ended without a solution.
    NotSolved(Status),
    /// The rates or a bounded path row are not a number somewhere between the nodes.
    Undefined,
    /// The largest error (28) is above the tolerance.
    AboveTolerance,
    /// A bound is far exceeded between the nodes: by a twentieth of its size or, where controls may
    /// jump, by a tenth for longer than an instant.
    BoundExceeded,
    /// Cost and error grow as the mesh gets finer: what solves the programme on each mesh is no
    /// approximation of a motion.
    Diverging,
}

impl Verdict {
    /// Whether all conditions are met, an overshoot for an instant allowed.
    pub fn is_converged(self) -> bool {
        matches!(self, Self::Converged | Self::Overshoots)
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Converged => "converged",
            Self::Overshoots => {
                "converged; controls overshoot a limit for an instant between the points of the mesh"
            }
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
