//! One problem, one plan.

use crate::error::Failure;
use crate::monitor::Monitor;
use crate::problem::Problem;
use crate::progress::Progress;
use crate::solution::Solution;
use crate::watched::watched;
use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::planner::{Event, Method, Plan, Planner, Start};
use ffsm_ipopt::refine;
use ffsm_ipopt::solution::{Saved, search as saved_search};
use ffsm_ipopt::study::search::{Optima, Search};
use pyo3::prelude::*;
use std::sync::Arc;

/// Plans a problem: `search` has the number of starts and the seed.
#[pyfunction]
#[pyo3(signature = (problem, start, search, method, verify, on_progress))]
pub fn plan(
    py: Python<'_>,
    problem: &Problem,
    start: Option<&Solution>,
    search: Option<(usize, u64)>,
    method: Option<&str>,
    verify: bool,
    on_progress: Option<Py<PyAny>>,
) -> PyResult<Solution> {
    let mut monitor = Monitor::new(on_progress);
    py.detach(|| {
        let (method, file) = chosen(method, &problem.file)?;
        let start = start.map(|start| start.start(&file)).transpose()?;
        let planned = match search {
            None => alone(method, &file, start.as_ref(), &mut monitor),
            Some(search) => searched(search, method, &file, start.as_ref(), &mut monitor),
        };
        let (mut plan, optima) = monitor.finish(planned)?;
        if verify {
            plan.verify(&file.problem);
        }
        let mut saved = Saved::planned(ProblemFile::clone(&file), plan);
        saved.solution.search = optima.as_ref().map(saved_search);
        Ok::<_, Failure>(Solution { saved })
    })
    .map_err(PyErr::from)
}

/// The method of that name, else the problem's, and the problem as it says so: a solution keeps it.
fn chosen(
    name: Option<&str>,
    file: &Arc<ProblemFile>,
) -> Result<(Method, Arc<ProblemFile>), Failure> {
    let own = Method::Collocation(file.problem.mesh.method);
    let Some(name) = name.filter(|name| *name != own.name()) else {
        return Ok((own, file.clone()));
    };
    let method = Method::ALL.into_iter().find(|method| method.name() == name);
    let method = method.ok_or_else(|| {
        let names = Method::ALL.map(Method::name).join(", ");
        Failure::Argument(format!("method: {name:?}; expected one of {names}"))
    })?;
    let file = match method {
        Method::Collocation(_) => {
            let mut overrides = Overrides::default();
            overrides.text(&format!("--method {name}"), "mesh.method", name);
            Arc::new(file.edited(&overrides)?)
        }
        _ => file.clone(),
    };
    Ok((method, file))
}

type Planned = Result<(Plan, Option<Optima>), Failure>;

/// A plan from one start.
fn alone(
    method: Method,
    file: &ProblemFile,
    start: Option<&Start>,
    monitor: &mut Monitor,
) -> Planned {
    let mut tell = |event: &Event<'_>| match Progress::of(event) {
        Some(step) => monitor.tell(|_, callback| callback.call1((step.values(),)).map(drop)),
        None => monitor.ask(),
    };
    let plan = Planner::new().plan_by(method, &file.problem, start, &mut tell);
    let plan = plan.map_err(|error| Failure::planning(file, error))?;
    Ok((plan, None))
}

/// The best plan from many.
fn searched(
    (starts, seed): (usize, u64),
    method: Method,
    file: &ProblemFile,
    start: Option<&Start>,
    monitor: &mut Monitor,
) -> Planned {
    let Method::Collocation(refine::Method::Adaptive | refine::Method::Global) = method else {
        return Err(Failure::Argument(format!(
            "search with method {:?}: this method has no starts to choose from",
            method.name()
        )));
    };
    let search = Search { starts, seed };
    let found = watched(monitor, |tell| {
        search.run(&file.problem, start, &mut |event| {
            tell(Progress::of_search(event))
        })
    });
    let found = found.map_err(|error| {
        Failure::Argument(format!("search: no thread can be started for it: {error}"))
    })?;
    let found = found.map_err(|error| Failure::planning(file, error))?;
    Ok((found.plan, Some(found.optima)))
}
