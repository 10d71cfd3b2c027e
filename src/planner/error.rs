//! Why there is no plan at all.

use crate::collocation::MeshError;
use crate::nlp::ipopt;
use crate::problem::ProblemError;
use crate::refine::SolveError;

/// Why there is no plan at all.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The problem cannot be.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// The mesh cannot be.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The solver refused it.
    #[error(transparent)]
    Ipopt(#[from] ipopt::IpoptError),
    /// The optimal control problem cannot be solved.
    #[error(transparent)]
    Solve(SolveError),
    /// A warm start that belongs to another robot.
    #[error(
        "warm start: the trajectory has {found} states and {controls} controls; the problem has {expected} and {joints}"
    )]
    Start {
        /// States of the trajectory.
        found: usize,
        /// Controls of the trajectory.
        controls: usize,
        /// States of the problem.
        expected: usize,
        /// Joints of the problem.
        joints: usize,
    },
}

impl From<SolveError> for PlanError {
    fn from(error: SolveError) -> Self {
        match error {
            SolveError::Mesh(error) => Self::Mesh(error),
            SolveError::Ipopt(error) => Self::Ipopt(error),
            error => Self::Solve(error),
        }
    }
}
