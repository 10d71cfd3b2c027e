//! A problem and where it comes from.

use crate::error::Failure;
use ffsm_ipopt::cli::understood;
use ffsm_ipopt::config::{Overrides, ProblemFile, Starter};
use pyo3::prelude::*;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A problem; cannot be changed.
#[pyclass(frozen, module = "ffsm_ipopt._native")]
#[derive(Debug)]
pub struct Problem {
    pub file: Arc<ProblemFile>,
}

impl From<ProblemFile> for Problem {
    fn from(file: ProblemFile) -> Self {
        Self {
            file: Arc::new(file),
        }
    }
}

#[pymethods]
impl Problem {
    /// The problem in a file, values as of `--set` laid over it.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf, values: Vec<String>) -> PyResult<Self> {
        py.detach(|| {
            let overrides = Overrides::of(&values)?;
            Ok::<_, Failure>(ProblemFile::load(&path, &overrides)?.into())
        })
        .map_err(PyErr::from)
    }

    /// The problem in a text that stands for the file at `path`; where nobody wrote that text, errors
    /// do not name its lines.
    #[staticmethod]
    fn of_text(
        py: Python<'_>,
        path: PathBuf,
        text: String,
        values: Vec<String>,
        written: bool,
    ) -> PyResult<Self> {
        py.detach(|| {
            let overrides = Overrides::of(&values)?;
            let file = ProblemFile::of_text(&path, &text, &overrides);
            let file = file.map_err(|error| match written {
                true => error,
                false => error.without_lines_of(&path.display().to_string()),
            })?;
            Ok::<_, Failure>(file.into())
        })
        .map_err(PyErr::from)
    }

    /// A first problem for the robot in a URDF file, as `init --urdf` writes it.
    #[staticmethod]
    fn of_urdf(py: Python<'_>, path: PathBuf, values: Vec<String>) -> PyResult<Self> {
        py.detach(|| {
            let overrides = Overrides::of(&values)?;
            let name = path.file_name().unwrap_or(OsStr::new("")).to_string_lossy();
            let starter = Starter::of_urdf(&path, &name)?;
            let at = path.with_file_name(Path::new("problem.toml"));
            Ok::<_, Failure>(ProblemFile::of_text(&at, &starter.problem, &overrides)?.into())
        })
        .map_err(PyErr::from)
    }

    /// The problem again that [`Problem::texts`] gave.
    #[staticmethod]
    fn restore(
        py: Python<'_>,
        problem: (String, String),
        robot: (String, String),
        options: Vec<String>,
    ) -> PyResult<Self> {
        py.detach(|| {
            let problem = (problem.0.as_str(), problem.1.as_str());
            let robot = (robot.0.as_str(), robot.1.as_str());
            let file = ProblemFile::restore(problem, robot, &options)?;
            Ok::<_, Failure>(file.into())
        })
        .map_err(PyErr::from)
    }

    /// The problem again with more values laid over it.
    fn edited(&self, py: Python<'_>, values: Vec<String>) -> PyResult<Self> {
        py.detach(|| {
            let overrides = Overrides::of(&values)?;
            Ok::<_, Failure>(self.file.edited(&overrides)?.into())
        })
        .map_err(PyErr::from)
    }

    /// Path and text of the problem's file, the same of the robot's, and the values laid over it.
    fn texts(&self) -> ((&str, &str), (&str, &str), &[String]) {
        let file = &*self.file;
        (
            (&file.path, &file.text),
            (&file.robot.path, &file.robot.text),
            &file.overrides,
        )
    }

    /// What `check` prints.
    fn understood(&self, py: Python<'_>) -> String {
        py.detach(|| understood(&self.file))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.file.problem.name
    }

    #[getter]
    fn robot(&self) -> &str {
        self.file.problem.robot.name()
    }

    #[getter]
    fn joint_names(&self) -> Vec<&str> {
        let joints = self.file.problem.robot.joints().iter();
        joints.map(|joint| joint.name.as_str()).collect()
    }

    #[getter]
    fn duration(&self) -> (f64, f64) {
        let duration = &self.file.problem.task.duration;
        (duration.lower, duration.upper)
    }

    #[getter]
    fn attitude(&self) -> &'static str {
        let problem = &self.file.problem;
        match problem.robot.plane() {
            Some(_) => "angle",
            None => problem.attitude.name(),
        }
    }

    #[getter]
    fn end_effector(&self) -> Option<&str> {
        self.file.end_effector.as_deref()
    }

    #[getter]
    fn notes(&self) -> Vec<&str> {
        self.file.notes.iter().map(String::as_str).collect()
    }

    #[getter]
    fn repairs(&self) -> Vec<&str> {
        self.file.repairs.iter().map(String::as_str).collect()
    }
}
