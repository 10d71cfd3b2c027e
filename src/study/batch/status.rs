//! How a row of a batch ended.

use crate::planner::Status;
use serde::{Deserialize, Serialize};

/// How a row of a batch ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum RowStatus {
    /// All limits hold and the largest error is within the tolerance.
    Solved,
    /// No trajectory within the limits was found.
    Infeasible,
    /// The tolerance was not met, or the solver gave up.
    NotConverged,
    /// No motion can carry out the task; found before any solve.
    Impossible,
    /// The values make no problem.
    Malformed,
    /// It took longer than its time limit.
    TimedOut,
    /// Its process took more memory than there is, or than it may.
    OutOfMemory,
    /// Its process died.
    Crashed,
    /// The program found a fault in itself.
    Panicked,
    /// Planning ended with an error.
    Failed,
    /// Stopped from outside; such a row is left for another run.
    Interrupted,
}

impl RowStatus {
    /// All that a data set can have.
    pub const ALL: [Self; 10] = [
        Self::Solved,
        Self::Infeasible,
        Self::NotConverged,
        Self::Impossible,
        Self::Malformed,
        Self::TimedOut,
        Self::OutOfMemory,
        Self::Crashed,
        Self::Panicked,
        Self::Failed,
    ];

    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solved => "solved",
            Self::Infeasible => "infeasible",
            Self::NotConverged => "not_converged",
            Self::Impossible => "impossible",
            Self::Malformed => "malformed",
            Self::TimedOut => "timed_out",
            Self::OutOfMemory => "out_of_memory",
            Self::Crashed => "crashed",
            Self::Panicked => "panicked",
            Self::Failed => "failed",
            Self::Interrupted => "interrupted",
        }
    }

    /// The status of that name.
    pub fn of(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|status| status.name() == name)
    }
}

impl From<Status> for RowStatus {
    fn from(status: Status) -> Self {
        match status {
            Status::Solved => Self::Solved,
            Status::Infeasible => Self::Infeasible,
            Status::NotConverged => Self::NotConverged,
            Status::Interrupted => Self::Interrupted,
        }
    }
}
