//! Errors of the library as exceptions of Python.

use ffsm_ipopt::config::{ConfigError, ProblemFile};
use ffsm_ipopt::planner::PlanError;
use ffsm_ipopt::report::OutputError;
use ffsm_ipopt::solution::SolutionError;
use ffsm_ipopt::solution::dataset::{DataSetError, RunError};
use ffsm_ipopt::study::batch::EngineError;
use pyo3::exceptions::{PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

/// What keeps a call from its result.
#[derive(Debug)]
pub enum Failure {
    Config(ConfigError),
    Solution(SolutionError),
    Plan(PlanError),
    Engine(EngineError),
    Output(OutputError),
    DataSet(DataSetError),
    /// Records cannot be told to the batch.
    Pipe(std::io::Error),
    /// An argument that cannot be.
    Argument(String),
    /// A solution that cannot be written as JSON.
    Json(serde_json::Error),
    /// What a callback or a signal raised.
    Raised(PyErr),
}

impl Failure {
    /// An error of planning the problem in `file`; one of the problem itself gets its place.
    pub fn planning(file: &ProblemFile, error: PlanError) -> Self {
        match error {
            PlanError::Problem(error) => Self::Config(file.blame(error)),
            error => Self::Plan(error),
        }
    }
}

impl From<ConfigError> for Failure {
    fn from(error: ConfigError) -> Self {
        Self::Config(error)
    }
}

impl From<SolutionError> for Failure {
    fn from(error: SolutionError) -> Self {
        Self::Solution(error)
    }
}

impl From<DataSetError> for Failure {
    fn from(error: DataSetError) -> Self {
        Self::DataSet(error)
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::DataSet(error) => Self::DataSet(error),
            RunError::Engine(error) => Self::Engine(error),
            RunError::Solution(error) => Self::Solution(error),
            error => Self::Argument(error.to_string()),
        }
    }
}

impl From<OutputError> for Failure {
    fn from(error: OutputError) -> Self {
        Self::Output(error)
    }
}

impl From<serde_json::Error> for Failure {
    fn from(error: serde_json::Error) -> Self {
        Self::Json(error)
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        Python::attach(|py| match &failure {
            Failure::Config(error) => config(py, error).unwrap_or_else(|raised| raised),
            Failure::Solution(error) => {
                let place = (
                    error.key(),
                    error.path().display().to_string(),
                    None::<usize>,
                );
                let class = class(py, "SolutionError");
                class
                    .and_then(|class| class.call1((error.to_string(), place.0, place.1, place.2)))
                    .map_or_else(|raised| raised, PyErr::from_value)
            }
            Failure::Plan(error) => class(py, "PlanError")
                .and_then(|class| class.call1((error.to_string(),)))
                .map_or_else(|raised| raised, PyErr::from_value),
            Failure::Engine(error) => PyRuntimeError::new_err(error.to_string()),
            Failure::Output(error) => PyOSError::new_err(error.to_string()),
            Failure::DataSet(error) => data_set(py, error).unwrap_or_else(|raised| raised),
            Failure::Pipe(error) => PyOSError::new_err(error.to_string()),
            Failure::Argument(message) => PyValueError::new_err(message.clone()),
            Failure::Json(error) => PyRuntimeError::new_err(error.to_string()),
            Failure::Raised(raised) => raised.clone_ref(py),
        })
    }
}

/// `ProblemError` with key and place, and with all faults where there are several.
fn config(py: Python<'_>, error: &ConfigError) -> PyResult<PyErr> {
    let faults = match error {
        ConfigError::Several { faults, .. } => faults
            .iter()
            .map(|fault| config(py, fault))
            .collect::<PyResult<Vec<_>>>()?,
        _ => Vec::new(),
    };
    // Of several faults the place is that of the first, as the key is.
    let place = match error {
        ConfigError::Several { faults, .. } => faults.first().unwrap_or(error).place(),
        error => error.place(),
    };
    let key = error.key();
    let arguments = (
        error.to_string(),
        key.as_deref(),
        place.source.as_ref(),
        place.line,
        faults,
    );
    let raised = class(py, "ProblemError")?.call1(arguments)?;
    Ok(PyErr::from_value(raised))
}

/// `DataSetError`, or the one of a folder that another run writes to.
fn data_set(py: Python<'_>, error: &DataSetError) -> PyResult<PyErr> {
    let name = match error {
        DataSetError::Locked { .. } => "DataSetInUseError",
        _ => "DataSetError",
    };
    let path = error.path().display().to_string();
    let raised = class(py, name)?.call1((error.to_string(), None::<&str>, path))?;
    Ok(PyErr::from_value(raised))
}

/// A class of the package's errors.
fn class<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("ffsm_ipopt.errors")?.getattr(name)
}
