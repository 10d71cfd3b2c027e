//! What keeps a command from being carried out, and the exit status it ends with.

use super::Outcome;
use crate::collocation::MeshError;
use crate::config::{ConfigError, ProblemFile};
use crate::nlp::ipopt::IpoptError;
use crate::planner::PlanError;
use crate::report::OutputError;
use crate::reproduction::ReproductionError;
use crate::simulate::SimulateError;
use crate::solution::SolutionError;
use crate::solution::dataset::{DataSetError, RunError};
use crate::study::batch::EngineError;
use crate::study::dispersion::DispersionError;
use std::path::Path;

/// What keeps a command from being carried out.
#[derive(Debug, thiserror::Error)]
pub(super) enum Failure {
    #[error(transparent)]
    Config(#[from] ConfigError),
    #[error(transparent)]
    Solution(#[from] SolutionError),
    #[error("{path}: {cause}")]
    Start { path: String, cause: PlanError },
    #[error("{path}: {cause}")]
    Simulate { path: String, cause: SimulateError },
    #[error("{path}: {cause}")]
    Disperse {
        path: String,
        cause: DispersionError,
    },
    #[error(transparent)]
    Output(#[from] OutputError),
    #[error("{path}: {cause}")]
    Plan { path: String, cause: PlanError },
    #[error("{path}: the solution cannot be written: {message}")]
    Format { path: String, message: String },
    #[error("{0}")]
    Usage(String),
    #[error(transparent)]
    Reproduction(#[from] ReproductionError),
    #[error("standard output cannot be written: {0}")]
    Terminal(std::io::Error),
    #[error(transparent)]
    DataSet(#[from] DataSetError),
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error(
        "the path of this program, which is to plan in processes of its own, is not known: {cause}"
    )]
    Program { cause: std::io::Error },
    #[error("no linear solver works with this Ipopt; install one, such as MUMPS")]
    NoLinearSolver,
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::DataSet(error) => Self::DataSet(error),
            RunError::Engine(error) => Self::Engine(error),
            RunError::Solution(error) => Self::Solution(error),
            error @ (RunError::NoProblem { .. } | RunError::RetryOfShard) => {
                Self::Usage(error.to_string())
            }
        }
    }
}

impl Failure {
    /// 2 where the input is to blame, else 1.
    pub(super) fn code(&self) -> u8 {
        match self {
            Self::Disperse {
                cause: DispersionError::Interrupted { .. },
                ..
            } => Outcome::Interrupted as u8,
            Self::Usage(_)
            | Self::Config(_)
            | Self::Solution(_)
            | Self::Start { .. }
            | Self::Simulate { .. }
            | Self::Disperse { .. } => 2,
            Self::Output(OutputError::Folder { .. }) => 2,
            Self::Output(OutputError::File { .. } | OutputError::Figure { .. }) => 1,
            Self::Plan { .. } | Self::Format { .. } | Self::Terminal(_) => 1,
            Self::NoLinearSolver | Self::Engine(_) | Self::Program { .. } => 1,
            Self::DataSet(DataSetError::Write { .. } | DataSetError::Encode { .. }) => 1,
            Self::DataSet(_) => 2,
            Self::Reproduction(ReproductionError::Interrupted) => Outcome::Interrupted as u8,
            Self::Reproduction(
                ReproductionError::Config(_)
                | ReproductionError::Solution(_)
                | ReproductionError::Simulate { .. },
            ) => 2,
            Self::Reproduction(_) => 1,
        }
    }

    /// The failure of planning the problem in `file`, put down to the key that is to blame.
    pub(super) fn planning(
        file: &ProblemFile,
        warm_start: Option<&Path>,
        error: PlanError,
    ) -> Self {
        let value = |key: &str, found: String, expected: &str| {
            Self::Config(ConfigError::Value {
                place: file.place(key),
                key: key.into(),
                found,
                expected: expected.into(),
            })
        };
        match (error, warm_start) {
            (PlanError::Problem(error), _) => Self::Config(file.blame(error)),
            (PlanError::Mesh(MeshError::TooMany { what, found, most }), _) => {
                // Each way-point is a breakpoint more.
                let key = match file.problem.task.way_points.is_empty() {
                    true => "mesh",
                    false => "task.way_points",
                };
                let found = format!("{what} of {found} collocation points");
                value(key, found, &format!("at most {most}"))
            }
            (PlanError::Ipopt(IpoptError::OptionRefused { name, value: given }), _) => {
                let key = match name.as_str() {
                    "linear_solver" => "solver.linear_solver".into(),
                    "tol" => "solver.tolerance".into(),
                    _ => format!("solver.options.{name}"),
                };
                value(&key, given, "an option and value that this Ipopt knows")
            }
            (PlanError::Ipopt(IpoptError::OptionsRefused { linear_solver }), _) => {
                let expected = "a linear solver that works here, see ffsm-ipopt doctor";
                value("solver.linear_solver", linear_solver.to_string(), expected)
            }
            (PlanError::Ipopt(error @ IpoptError::MissingLibrary { .. }), _) => {
                let expected = "a linear solver that works here, see ffsm-ipopt doctor";
                value("solver.linear_solver", error.to_string(), expected)
            }
            (cause @ PlanError::Start { .. }, Some(path)) => Self::Start {
                path: path.display().to_string(),
                cause,
            },
            (
                cause @ PlanError::Ipopt(
                    IpoptError::StartDimension { .. } | IpoptError::StartNotFinite { .. },
                ),
                Some(path),
            ) => Self::Start {
                path: path.display().to_string(),
                cause,
            },
            (cause, _) => Self::Plan {
                path: file.path.clone(),
                cause,
            },
        }
    }
}
