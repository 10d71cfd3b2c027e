//! Why there is no plan at all.

use crate::collocation::MeshError;
use crate::nlp::ipopt;
use crate::problem::ProblemError;

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
