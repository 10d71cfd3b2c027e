//! Many problems, each planned as if it were alone.

use crate::arrays::motion;
use crate::error::Failure;
use crate::monitor::Monitor;
use crate::problem::Problem;
use crate::solution::Solution;
use ffsm_ipopt::config::ProblemFile;
use ffsm_ipopt::study::batch::{Engine, Event, Figures, Record, Refusal, Task, Tasks};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::num::NonZero;
use std::sync::Arc;

/// Problems in a row; their positions are their keys.
struct Problems(Vec<Arc<ProblemFile>>);

impl Tasks for Problems {
    fn count(&self) -> u64 {
        self.0.len() as u64
    }

    fn key(&self, position: u64) -> String {
        position.to_string()
    }

    fn task(&self, position: u64) -> Result<Task, Refusal> {
        Ok(Task {
            problem: self.0[position as usize].problem.clone(),
            cells: Vec::new(),
        })
    }
}

/// Plans problems side by side and calls `on_record` for each as it ends, in no order.
#[pyfunction]
#[pyo3(signature = (problems, jobs, start, motions, on_record))]
pub fn plan_many(
    py: Python<'_>,
    problems: Vec<Py<Problem>>,
    jobs: Option<NonZero<usize>>,
    start: Option<&Solution>,
    motions: bool,
    on_record: Py<PyAny>,
) -> PyResult<()> {
    let files = problems.iter().map(|problem| problem.get().file.clone());
    let problems = Problems(files.collect());
    let mut monitor = Monitor::new(Some(on_record));
    py.detach(|| {
        let mut engine = Engine::default();
        engine.jobs = jobs.unwrap_or(engine.jobs);
        engine.motions = motions;
        engine.start = match (start, problems.0.first()) {
            (Some(start), Some(first)) => Some(start.start(first)?),
            _ => None,
        };
        let positions = 0..problems.count();
        let ran = engine.run(&problems, positions, &mut |event| match event {
            Event::Record(record) => monitor.tell(|py, callback| tell(py, callback, *record)),
            _ => monitor.ask(),
        });
        monitor.finish(ran.map_err(Failure::Engine))
    })
    .map_err(PyErr::from)
}

/// Calls `callback` with what became of a problem.
fn tell(py: Python<'_>, callback: &Bound<'_, PyAny>, record: Record) -> PyResult<()> {
    let figures = record
        .figures
        .map(|found| figures(py, &found))
        .transpose()?;
    let motion = record.motion.map(|found| motion!(found).into_arrays(py));
    let arguments = (
        record.position,
        record.name,
        record.status.name(),
        record.reason,
        record.seconds,
        figures,
        motion.transpose()?,
    );
    callback.call1(arguments).map(drop)
}

/// The figures of a plan by their names.
fn figures<'py>(py: Python<'py>, found: &Figures) -> PyResult<Bound<'py, PyDict>> {
    let figures = PyDict::new(py);
    macro_rules! set {
        ($($name:ident)*) => {
            $(figures.set_item(stringify!($name), &found.$name)?;)*
        };
    }
    set!(objective max_error points segments mesh_iterations nlp_iterations max_base_attitude
        final_base_attitude max_base_displacement final_base_displacement peak_joint_velocity
        peak_joint_torque goal_distance goal_angle verification_attitude verification_position
        verification_joint);
    Ok(figures)
}
