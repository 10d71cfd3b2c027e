//! Plans one after another, each from nothing, with their time.

use crate::config::ConfigError;
use crate::nlp::Control;
use crate::planner::{Event, Method, Plan, PlanError, Planner, Status};
use crate::problem::{Problem, ProblemError};
use crate::refine::Start;
use crate::report::OutputError;
use crate::simulate::SimulateError;
use crate::solution::SolutionError;
use crate::study::Comparison;
use crate::study::pareto::ParetoFront;
use crate::study::search::{Search, SearchEvent};
use rustix::time::{ClockId, clock_gettime};

/// Why nothing came of it.
#[derive(Debug, thiserror::Error)]
pub enum ReproductionError {
    /// A shipped problem cannot be read.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// A problem made from a shipped one cannot be.
    #[error(transparent)]
    Problem(#[from] ProblemError),
    /// A plan cannot be made.
    #[error("{title}: {cause}")]
    Plan {
        /// What was being planned.
        title: String,
        /// Why not.
        cause: PlanError,
    },
    /// A saved plan cannot be used.
    #[error(transparent)]
    Solution(#[from] SolutionError),
    /// A plan cannot be played on the platform.
    #[error("{name}: {cause}")]
    Simulate {
        /// The fit file, or what was being played.
        name: String,
        /// Why not.
        cause: SimulateError,
    },
    /// Stopped from outside.
    #[error("interrupted: nothing further was written")]
    Interrupted,
    /// A result cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A result cannot be put into words.
    #[error("{name}: cannot be written: {message}")]
    Format {
        /// The file.
        name: String,
        /// Why not.
        message: String,
    },
}

/// A step of the work, for a progress line.
#[derive(Debug, Clone, Copy)]
pub enum Step<'a> {
    /// Something new begins.
    Begin(&'a str),
    /// A step of planning.
    Event(&'a SearchEvent<'a>),
}

/// One plan and the processor time it took.
#[derive(Debug, Clone)]
pub struct Run {
    /// The plan.
    pub plan: Plan,
    /// Processor time of this process, s.
    pub cpu_seconds: f64,
}

/// Plans one after another; the monitor is told and can stop it.
pub struct Session<'m> {
    monitor: &'m mut (dyn FnMut(Step<'_>) -> Control + Send),
    /// What comparisons and fronts search with.
    search: Option<Search>,
}

impl std::fmt::Debug for Session<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Session").finish_non_exhaustive()
    }
}

impl<'m> Session<'m> {
    /// A session that tells `monitor` of every step.
    pub fn new(monitor: &'m mut (dyn FnMut(Step<'_>) -> Control + Send)) -> Self {
        Self {
            monitor,
            search: None,
        }
    }

    /// The same with a search from many starts wherever planners are compared and along fronts. Tables
    /// and figures of the paper are of one start each, as published.
    pub fn searching(self, search: Option<Search>) -> Self {
        Self { search, ..self }
    }

    /// What a command of this program is given for the same search.
    pub fn search_flags(&self) -> String {
        let flags = |search: &Search| format!(" --search {} --seed {}", search.starts, search.seed);
        self.search.as_ref().map(flags).unwrap_or_default()
    }

    /// Says that something new begins.
    ///
    /// # Errors
    /// [`ReproductionError::Interrupted`] where the monitor stops it here.
    pub fn begin(&mut self, title: &str) -> Result<(), ReproductionError> {
        match (self.monitor)(Step::Begin(title)) {
            Control::Stop => Err(ReproductionError::Interrupted),
            Control::Continue => Ok(()),
        }
    }

    /// Passes a step of planning on to the monitor.
    pub(super) fn show(&mut self, event: &Event<'_>) -> Control {
        self.show_step(&SearchEvent::of_plan(*event))
    }

    /// The same of a step that a search may be part of.
    fn show_step(&mut self, event: &SearchEvent<'_>) -> Control {
        (self.monitor)(Step::Event(event))
    }

    /// Plans `problem` with a fresh planner, by the method of its mesh.
    ///
    /// # Errors
    /// [`ReproductionError::Plan`], and [`ReproductionError::Interrupted`] where the monitor
    /// stops it; a problem without a solution is a plan all the same.
    pub fn plan(
        &mut self,
        title: &str,
        problem: &Problem,
        start: Option<&Start>,
    ) -> Result<Run, ReproductionError> {
        let began = processor_seconds();
        let method = Method::Collocation(problem.mesh.method);
        let plan = self.make(method, title, problem, start)?;
        Ok(Run {
            plan,
            cpu_seconds: processor_seconds() - began,
        })
    }

    /// Plans `problem` with a fresh planner by any method.
    ///
    /// # Errors
    /// Those of [`Self::plan`].
    pub fn plan_by(
        &mut self,
        method: Method,
        title: &str,
        problem: &Problem,
    ) -> Result<Plan, ReproductionError> {
        self.make(method, title, problem, None)
    }

    /// Plans `problem` by every method.
    ///
    /// # Errors
    /// Those of [`Self::plan`].
    pub fn compare(&mut self, problem: &Problem) -> Result<Comparison, ReproductionError> {
        let title = format!("{} by every planner", problem.name);
        self.begin(&title)?;
        let search = self.search.clone();
        let mut told = |_, event: &SearchEvent<'_>| self.show_step(event);
        let found = Comparison::plan(problem, search.as_ref(), &mut told)
            .map_err(|cause| ReproductionError::Plan { title, cause })?;
        let plans = found
            .entries
            .iter()
            .filter_map(|entry| entry.plan.as_ref().ok());
        refuse_interrupted(plans)?;
        Ok(found)
    }

    /// Plans along `front` for every factor.
    ///
    /// # Errors
    /// Those of [`Self::plan`].
    pub fn sweep(
        &mut self,
        name: &str,
        front: &mut ParetoFront<'_>,
        factors: &[f64],
    ) -> Result<(), ReproductionError> {
        let title = format!("{name}, base motion against joint effort");
        self.begin(&title)?;
        if let Some(search) = self.search.clone() {
            front.search(search);
        }
        front
            .sweep(factors, &mut |_, event| self.show_step(event))
            .map_err(|cause| ReproductionError::Plan { title, cause })?;
        refuse_interrupted(front.points().iter().map(|point| &point.plan))
    }

    fn make(
        &mut self,
        method: Method,
        title: &str,
        problem: &Problem,
        start: Option<&Start>,
    ) -> Result<Plan, ReproductionError> {
        self.begin(title)?;
        let monitor = &mut *self.monitor;
        let plan = Planner::new()
            .plan_by(method, problem, start, &mut |&event| {
                monitor(Step::Event(&SearchEvent::of_plan(event)))
            })
            .map_err(|cause| ReproductionError::Plan {
                title: title.into(),
                cause,
            })?;
        refuse_interrupted([&plan])?;
        Ok(plan)
    }
}

fn refuse_interrupted<'p>(
    plans: impl IntoIterator<Item = &'p Plan>,
) -> Result<(), ReproductionError> {
    let stopped = |plan: &Plan| plan.status == Status::Interrupted;
    match plans.into_iter().any(stopped) {
        true => Err(ReproductionError::Interrupted),
        false => Ok(()),
    }
}

/// Processor time this process has used, s.
fn processor_seconds() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}
