//! A plan with the problem it is for.

use crate::arrays::motion;
use crate::error::Failure;
use crate::problem::Problem;
use ffsm_ipopt::config::ProblemFile;
use ffsm_ipopt::planner::Start;
use ffsm_ipopt::report::{OutputFolder, verification_json};
use ffsm_ipopt::solution::{Saved, Trajectory, to_json, warm_start};
use ffsm_ipopt::system::at_fractions;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use serde_json::json;
use std::path::{Path, PathBuf};

/// Name of a solution in errors where it is in no file.
const NO_FILE: &str = "<solution>";

/// A plan with the problem it is for; cannot be changed.
#[pyclass(frozen, module = "ffsm_ipopt._native")]
#[derive(Debug)]
pub struct Solution {
    pub saved: Saved,
}

impl Solution {
    /// The plan as the start of another, of the problem in `file`.
    pub fn start(&self, file: &ProblemFile) -> Result<Start, Failure> {
        let solution = self.saved.solution.clone();
        Ok(warm_start(Path::new(NO_FILE), solution, file)?.start)
    }
}

#[pymethods]
impl Solution {
    /// The plan in a solution.json.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        py.detach(|| {
            let saved = Saved::load(&path)?;
            Ok::<_, Failure>(Self { saved })
        })
        .map_err(PyErr::from)
    }

    /// The plan in the text of a solution.json.
    #[staticmethod]
    fn of_text(py: Python<'_>, text: String) -> PyResult<Self> {
        py.detach(|| {
            let path = Path::new(NO_FILE);
            let solution = ffsm_ipopt::solution::parse_solution(path, &text)?;
            let saved = Saved::of(path, solution)?;
            Ok::<_, Failure>(Self { saved })
        })
        .map_err(PyErr::from)
    }

    /// The whole solution.json.
    fn text(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| to_json(&self.saved.solution).map_err(Failure::from))
            .map_err(PyErr::from)
    }

    /// Writes the solution.json, all of it or nothing.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| {
            let text = to_json(&self.saved.solution)?;
            let name = path.file_name().and_then(|name| name.to_str());
            let name = name.ok_or_else(|| {
                Failure::Argument(format!(
                    "path: {:?} names no file; expected one such as \"solution.json\"",
                    path.display().to_string()
                ))
            })?;
            let folder = match path.parent() {
                Some(folder) if !folder.as_os_str().is_empty() => folder,
                _ => Path::new("."),
            };
            OutputFolder::create(folder)?.write(name, &text)?;
            Ok::<_, Failure>(())
        })
        .map_err(PyErr::from)
    }

    /// What the solution.json has beside trajectory, mesh values and provenance, as JSON.
    fn figures(&self) -> String {
        let found = &self.saved.solution;
        json!({
            "name": found.name,
            "status": found.status,
            "method": found.method,
            "objective": finite(found.objective),
            "tolerance": finite(found.tolerance),
            "max_error": finite(found.max_error),
            "points": found.points,
            "segments": found.segments,
            "breakpoints": found.mesh.breakpoints,
            "points_per_segment": found.mesh.points_per_segment,
            "cost_terms": found.cost_terms,
            "iterations": found.iterations,
            "metrics": found.metrics,
            "goals": found.goals,
            "search": found.search,
            "verification": found.verification,
            "diagnosis": found.diagnosis,
            "warnings": found.warnings,
            "timing": found.timing,
        })
        .to_string()
    }

    /// Name of the status.
    #[getter]
    fn status(&self) -> &'static str {
        self.saved.solution.status.name()
    }

    /// Cost J.
    #[getter]
    fn objective(&self) -> f64 {
        self.saved.solution.objective
    }

    /// Duration, s.
    #[getter]
    fn duration(&self) -> f64 {
        self.saved.plan.duration
    }

    /// The problem.
    #[getter]
    fn problem(&self) -> Problem {
        self.saved.file.clone().into()
    }

    /// Times and quantities at the nodes.
    fn nodes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let planned: Trajectory = self.saved.solution.trajectory.clone();
        motion!(planned).into_arrays(py)
    }

    /// Times and quantities at these fractions of the duration, each from 0 to 1.
    fn sample<'py>(&self, py: Python<'py>, fractions: Vec<f64>) -> PyResult<Bound<'py, PyTuple>> {
        let (problem, plan) = (&self.saved.file.problem, &self.saved.plan);
        let sampled = py.detach(|| at_fractions(problem, plan, &fractions));
        motion!(sampled).into_arrays(py)
    }

    /// The verification.json of the plan, integrated again.
    fn verify(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| {
            let judgement = self.saved.judge();
            let json = verification_json(Path::new(NO_FILE), &self.saved, &judgement)?;
            Ok::<_, Failure>(json)
        })
        .map_err(PyErr::from)
    }
}

fn finite(figure: f64) -> Option<f64> {
    figure.is_finite().then_some(figure)
}
