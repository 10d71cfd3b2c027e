//! Why a problem was not solved at all.

use crate::collocation::MeshError;
use crate::nlp::ipopt::IpoptError;
use crate::ocp::FormulationError;

/// Why a problem was not solved at all. What was tried and did not converge is no error, but an
/// [`Outcome`](super::Outcome).
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The formulation cannot be.
    #[error(transparent)]
    Formulation(#[from] FormulationError),
    /// The settings of the mesh cannot be.
    #[error(transparent)]
    Settings(#[from] super::SettingError),
    /// The mesh cannot be.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The trajectory to begin with is of another problem.
    #[error(
        "the start has {found:?} states and controls: expected {expected:?}, those of the formulation"
    )]
    Start {
        /// States and controls of the trajectory.
        found: (usize, usize),
        /// Those of the problem.
        expected: (usize, usize),
    },
    /// The trajectory to begin with has not the problem's static parameters.
    #[error(
        "the start has {found} static parameters: expected {expected}, as many as the formulation"
    )]
    StartParameters {
        /// Parameters of the trajectory.
        found: usize,
        /// Those of the problem.
        expected: usize,
    },
    /// The duration to begin with is no time.
    #[error("the duration of the start is {0} s: expected a finite time above zero")]
    StartDuration(f64),
    /// A function of the problem leaves an output as it found it.
    #[error(
        "{output} ({name}) was never written: expected Ocp::{function} to write it on every call, or to write it before adding to it"
    )]
    Unwritten {
        /// The function of the trait.
        function: &'static str,
        /// Output in the code, such as `rates[1]`.
        output: String,
        /// What it is of.
        name: String,
    },
    /// A function of the problem has no finite value on the trajectory to begin with.
    #[error(
        "{output} ({name}) of Ocp::{function} is {value} at {t} s on the trajectory to begin with: give one where it is finite, see solve_from"
    )]
    Undefined {
        /// The function of the trait.
        function: &'static str,
        /// Output in the code, such as `path[0]`.
        output: String,
        /// What it is of.
        name: String,
        /// Time, s.
        t: f64,
        /// Its value.
        value: f64,
    },
    /// The solver refused it.
    #[error(transparent)]
    Ipopt(#[from] IpoptError),
}
