//! The planner: a first trajectory, refinement, and a diagnosis where there is none.

use super::elastic_start::led_within;
use super::first_mesh::first_mesh;
use super::sparsity_cache::SparsityCache;
use super::warnings::{reasons, warnings};
use super::{bound_warnings, diagnosis, retarget};
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::nlp::{self, Control, Deadline, ipopt};
use crate::planner::words::proven;
use crate::planner::{
    Diagnosis, Event, Method, Plan, PlanError, StartCounts, Status, Timing, floor,
};
use crate::problem::Problem;
use crate::refine::{CutShort, Outcome, Refinement, Start, Verdict, midpoint_errors};
use crate::system::{
    FreeFloating, JointPath, System, along, goal_errors_in, metrics, trajectory, with_system,
};
use crate::transcription::Patterns;
use std::time::{Duration, Instant};

/// Barrier parameter a saved solution is taken up with.
const WARM_BARRIER: f64 = 1e-8;

/// Plans `problem` with a fresh [`Planner`].
///
/// [`impossible`](crate::system::impossible) says in less than a millisecond what no motion can do:
/// asked first, it spares the diagnosis.
///
/// # Errors
/// [`PlanError`]; an infeasible or unconverged problem is no error but a [`Status`].
pub fn plan(problem: &Problem) -> Result<Plan, PlanError> {
    Planner::new().plan(problem)
}

/// Plans problems one after another and keeps what they share.
///
/// Sparsity patterns are found once; problems that differ in where the motion begins and ends, in
/// the mesh and in the solver alone reuse them.
#[derive(Debug, Default)]
pub struct Planner {
    sparsity: SparsityCache,
    /// Whether a plan that is not found is left without asking why.
    leaves_why: bool,
}

impl Planner {
    /// A planner with nothing kept yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The same without the diagnosis of what is not found: such plans end as not converged.
    pub fn without_diagnosis(self) -> Self {
        Self {
            leaves_why: true,
            ..self
        }
    }

    /// Plans `problem` from a straight joint path.
    ///
    /// [`impossible`](crate::system::impossible) says in less than a millisecond what no motion can do:
    /// asked first, it spares the diagnosis.
    ///
    /// # Errors
    /// [`PlanError`]; an infeasible or unconverged problem is no error but a [`Status`].
    pub fn plan(&mut self, problem: &Problem) -> Result<Plan, PlanError> {
        self.plan_with(problem, None, &mut |_| Control::Continue)
    }

    /// Plans `problem` from `start`, telling `monitor` of every step.
    ///
    /// The start is led to the problem's own ends first. One with multipliers makes the first solve
    /// a warm one; they may be those of a problem with other rows on the same robot.
    ///
    /// # Errors
    /// [`PlanError`]; an infeasible or unconverged problem is no error but a [`Status`].
    pub fn plan_with(
        &mut self,
        problem: &Problem,
        start: Option<&Start>,
        monitor: &mut dyn FnMut(&Event<'_>) -> Control,
    ) -> Result<Plan, PlanError> {
        let began = Instant::now();
        with_system!(&System::new(problem), system => {
            self.run(problem, system, start, monitor, began)
        })
    }

    fn run<Sp: Space>(
        &mut self,
        problem: &Problem,
        system: &FreeFloating<Sp>,
        start: Option<&Start>,
        monitor: &mut dyn FnMut(&Event<'_>) -> Control,
        began: Instant,
    ) -> Result<Plan, PlanError> {
        let mut solver = problem.solver.clone();
        if start.is_some_and(|start| start.iterate.is_some()) {
            solver.warm_start.get_or_insert(WARM_BARRIER);
        }
        let given = start.map(|given| led(given, problem, system)).transpose()?;
        let search = Search {
            problem,
            system,
            patterns: self.sparsity.patterns(problem, system),
            solver: &solver,
            deadline: Deadline::after(solver.time_limit),
        };
        let found = match (given, self.leaves_why) {
            (Some(given), true) => search.refine_within(&given, monitor)?,
            (None, true) => search.refine_within(&straight(problem, system)?, monitor)?,
            (given, false) => search.run(given.as_ref(), monitor)?,
        };
        Ok(assemble(problem, system, found, &solver, began))
    }
}

/// `given` led to the ends of `problem`.
fn led<Sp: Space>(
    given: &Start,
    problem: &Problem,
    system: &FreeFloating<Sp>,
) -> Result<Start, PlanError> {
    check_start(given, system)?;
    Ok(Start {
        trajectory: system.with_peaks(retarget::retarget(&given.trajectory, problem)),
        iterate: given.iterate.clone(),
    })
}

/// The straight joint path on the first mesh.
fn straight<Sp: Space>(problem: &Problem, system: &FreeFloating<Sp>) -> Result<Start, PlanError> {
    let path = JointPath::new(problem, &[]);
    let duration = problem.task.duration.center();
    let mesh = first_mesh(problem, system)?;
    Ok(Start {
        trajectory: along(system, duration, &path, mesh),
        iterate: None,
    })
}

/// What the search for a plan came to.
struct Found {
    status: Status,
    outcome: Outcome,
    diagnosis: Option<Diagnosis>,
}

impl Found {
    /// The same with what `earlier` took in its records and statistics.
    fn after(mut self, mut earlier: Outcome) -> Self {
        self.outcome.records.splice(0..0, earlier.records);
        earlier.statistics.add(&self.outcome.statistics);
        self.outcome.statistics = earlier.statistics;
        self
    }
}

struct Search<'a, Sp: Space> {
    problem: &'a Problem,
    system: &'a FreeFloating<Sp>,
    patterns: &'a Patterns,
    solver: &'a nlp::Settings,
    /// That of all solves together, the diagnosis included.
    deadline: Deadline,
}

impl<Sp: Space> Search<'_, Sp> {
    /// Refines from `given`, and from the straight path where there is none or where that fails; where
    /// nothing is found, asks why, and begins again from a trajectory within all limits where the
    /// answer is one.
    fn run(
        &self,
        given: Option<&Start>,
        monitor: &mut dyn FnMut(&Event<'_>) -> Control,
    ) -> Result<Found, PlanError> {
        if let Some(found) = self.along_the_only_path(monitor)? {
            return Ok(found);
        }
        let start = straight(self.problem, self.system)?;
        let mut first = self.refine_within(given.unwrap_or(&start), monitor)?;
        let misled = first.status == Status::NotConverged && asks_why(&first.outcome, self.solver);
        if given.is_some() && misled {
            let second = self.refine_within(&start, monitor)?;
            first = second.after(first.outcome);
        }
        if first.status != Status::NotConverged || !asks_why(&first.outcome, self.solver) {
            return Ok(first);
        }
        let mut outcome = first.outcome;
        let (problem, system) = (self.problem, self.system);
        let diagnosed =
            diagnosis::diagnose(problem, system, &outcome.trajectory, self.deadline, monitor)?;
        if self.deadline.has_passed() {
            outcome.cut_short = Some(CutShort::OutOfTime);
        }
        outcome.statistics.add(&diagnosed.statistics);
        let ended = |status, outcome, diagnosis| Found {
            status,
            outcome,
            diagnosis,
        };
        if diagnosed.interrupted {
            return Ok(ended(Status::Interrupted, outcome, None));
        }
        // What time ended before it was refined proves nothing, unless momentum does.
        let known = |diagnosis: &Diagnosis| {
            let proven = diagnosis.limits.iter().any(|limit| limit.floor.is_some());
            diagnosis.converged || proven || !self.deadline.has_passed()
        };
        if let Some(diagnosis) = diagnosed.diagnosis.filter(known) {
            outcome.trajectory = diagnosed.trajectory;
            outcome.objective = system.cost_terms(&outcome.trajectory).total();
            return Ok(ended(Status::Infeasible, outcome, Some(diagnosis)));
        }
        if !diagnosed.feasible || self.deadline.has_passed() {
            return Ok(ended(Status::NotConverged, outcome, None));
        }
        // On the first mesh again: that of the diagnosis was refined for another cost.
        let again = Start {
            trajectory: diagnosed.trajectory.resample(start.trajectory.mesh.clone()),
            iterate: None,
        };
        let found = self.refine(&again, monitor)?.after(outcome);
        if found.status != Status::NotConverged || found.outcome.status.is_solved() {
            return Ok(found);
        }
        // A limit that only just can be kept may need more points than the first mesh has.
        let finer = Start {
            trajectory: diagnosed.trajectory,
            iterate: None,
        };
        Ok(self.refine(&finer, monitor)?.after(found.outcome))
    }

    /// The answer for an arm whose only path exceeds a limit on the base's pose: a motion along it, all
    /// other limits kept. `None` where it exceeds none, and where the others leave no such motion.
    fn along_the_only_path(
        &self,
        monitor: &mut dyn FnMut(&Event<'_>) -> Control,
    ) -> Result<Option<Found>, PlanError> {
        let (problem, system) = (self.problem, self.system);
        let Some(path) = diagnosis::OnlyPath::of(problem, system)? else {
            return Ok(None);
        };
        let freed = path.freed(problem)?;
        let freed_system = system.of(&freed);
        let search = Search {
            problem: &freed,
            system: &freed_system,
            patterns: &Patterns::detect(&freed_system),
            solver: self.solver,
            deadline: self.deadline,
        };
        let found = search.refine_within(&straight(&freed, &freed_system)?, monitor)?;
        match found.status {
            Status::Solved => {}
            Status::Interrupted => return Ok(Some(found)),
            _ => return Ok(None),
        }
        let limits = path.findings(problem, system, &found.outcome.trajectory);
        let Some(mut limits) = limits.filter(|limits| !limits.is_empty()) else {
            return Ok(None);
        };
        floor::add(problem, system, &mut limits);
        Ok(Some(Found {
            status: Status::Infeasible,
            diagnosis: Some(Diagnosis {
                summary: proven(&limits),
                limits,
                starts: StartCounts {
                    tried: 1,
                    feasible: 1,
                },
                converged: true,
            }),
            ..found
        }))
    }

    /// Refines from `start`, led within the limits on the base first where it has no multipliers.
    fn refine_within(
        &self,
        start: &Start,
        monitor: &mut dyn FnMut(&Event<'_>) -> Control,
    ) -> Result<Found, PlanError> {
        let led = led_within(
            self.problem,
            self.system,
            start.clone(),
            &self.settings(),
            monitor,
        )?;
        let mut found = self.refine(&led.start, monitor)?;
        let own = std::mem::replace(&mut found.outcome.statistics, led.statistics);
        found.outcome.statistics.add(&own);
        Ok(found)
    }

    /// The solver's settings with the time that is left.
    fn settings(&self) -> nlp::Settings {
        nlp::Settings {
            time_limit: self.deadline.remaining(),
            ..self.solver.clone()
        }
    }

    fn refine(
        &self,
        start: &Start,
        monitor: &mut dyn FnMut(&Event<'_>) -> Control,
    ) -> Result<Found, PlanError> {
        let mut stopped = false;
        let solver = self.settings();
        let refinement = Refinement {
            ocp: self.system,
            patterns: self.patterns,
            settings: &self.problem.mesh,
            solver: &solver,
        };
        let outcome = refinement.run(start, &mut |event| {
            let control = monitor(&Event::Refinement(event));
            stopped |= control == Control::Stop;
            control
        })?;
        Ok(Found {
            status: grade(&outcome, stopped),
            outcome,
            diagnosis: None,
        })
    }
}

/// Whether it is to be asked which limits cannot hold: not where time ran out, nor where there are
/// solutions that only need finer meshes, nor where so few iterations were allowed that these alone
/// are the reason. They would be too few for the answer as well.
fn asks_why(outcome: &Outcome, solver: &nlp::Settings) -> bool {
    let last = outcome.records.last().map(|record| record.verdict);
    let too_few = outcome.status == nlp::Status::MaxIterations
        && solver.max_iterations < diagnosis::ITERATIONS;
    let unsolved = !outcome.status.is_solved() && !too_few;
    outcome.cut_short.is_none() && (unsolved || last == Some(Verdict::Diverging))
}

/// The plan of what was found.
fn assemble<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    found: Found,
    solver: &nlp::Settings,
    began: Instant,
) -> Plan {
    let Found {
        status,
        outcome,
        diagnosis,
    } = found;
    let trajectory = trajectory(system, &outcome.trajectory);
    let mut warnings = warnings(&trajectory, &outcome, solver);
    if status == Status::NotConverged {
        warnings.extend(reasons(problem, &outcome, &trajectory));
    }
    let max_error = if status == Status::Infeasible {
        midpoint_errors(system, &outcome.trajectory).max()
    } else {
        warnings.extend(bound_warnings::warnings(
            system,
            &outcome.trajectory,
            &outcome.violations,
        ));
        outcome.max_error()
    };
    Plan {
        status,
        method: Method::Collocation(problem.mesh.method),
        objective: outcome.objective,
        cost_terms: system.cost_terms(&outcome.trajectory),
        tolerance: problem.mesh.tolerance,
        max_error,
        metrics: metrics(system, &outcome.trajectory, &trajectory),
        goals: goal_errors_in(system, &outcome.trajectory),
        timing: timing(&outcome.statistics, began.elapsed()),
        linear_solver: linear_solver(solver, &outcome.statistics),
        iterations: outcome.records,
        discretization: outcome.trajectory,
        iterate: outcome.iterate,
        trajectory,
        diagnosis,
        verification: None,
        warnings,
    }
}

/// The linear solver behind a plan.
fn linear_solver(settings: &nlp::Settings, statistics: &nlp::Statistics) -> String {
    let mut name = ipopt::linear_solver(settings).to_string();
    if statistics.fallbacks > 0 {
        name.push_str(", mumps");
    }
    name
}

fn check_start<Sp: Space>(start: &Start, system: &FreeFloating<Sp>) -> Result<(), PlanError> {
    let joints = system.joint_count();
    let expected = system.attitude().count() + 2 * joints;
    let (found, controls) = (start.trajectory.states, start.trajectory.controls);
    if (found, controls) == (expected, joints) {
        Ok(())
    } else {
        Err(PlanError::Start {
            found,
            controls,
            expected,
            joints,
        })
    }
}

fn grade(outcome: &Outcome, stopped: bool) -> Status {
    if stopped || outcome.cut_short == Some(CutShort::Interrupted) {
        Status::Interrupted
    } else if outcome.converged {
        Status::Solved
    } else {
        Status::NotConverged
    }
}

fn timing(statistics: &nlp::Statistics, total: Duration) -> Timing {
    let known = statistics.derivatives + statistics.linear_solver;
    Timing {
        setup: total.saturating_sub(statistics.total),
        derivatives: statistics.derivatives,
        linear_solver: statistics.linear_solver,
        ipopt_other: statistics.total.saturating_sub(known),
        total,
    }
}
