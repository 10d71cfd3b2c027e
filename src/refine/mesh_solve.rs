//! The solve on one mesh: in units of the problem's sizes, warm where the mesh before allows it, and
//! again where its solution contradicts what was supposed of it.

use super::Start;
use super::assess::Assessed;
use super::assumptions::Assumptions;
use super::transfer::{Duals, saved_layout};
use crate::nlp::{
    self, Control, Deadline, Iterate, Progress, Scaled, Statistics, Status, Units, ipopt,
};
use crate::ocp::DynOcp;
use crate::transcription::{Discretization, Layout, Structure, Transcription};
use std::time::Duration;

/// Barrier parameter that a refined mesh starts with, as a part of the solver's tolerance: so far
/// below it that the first barrier problem is the last, and costs are as exact as from a cold start.
const REFINED_BARRIER: f64 = 0.1;

/// The same as a multiple of the error of the mesh before, where that is above [`ROUGH`]: far from
/// the solution a smaller barrier keeps the iterates at the wrong bounds.
const ERROR_BARRIER: f64 = 1e-5;
const ROUGH: f64 = 0.1;

/// The barrier parameter of a mesh with a structure, whose bounds are others than those before.
const STRUCTURE_BARRIER: f64 = 1e-6;

/// Iterations after which a mesh with a structure is given up: with the right one it takes fewer.
const STRUCTURE_ITERATIONS: u32 = 200;

/// Iterations after which a warm start is given up for one with a wider barrier: far from the solution
/// a small barrier makes steps short, hundreds in a row.
const WARM_ITERATIONS: u32 = 100;

/// The barrier parameter of that one, and its iterations. A cold start's barrier is so wide that it
/// leaves the basin of the mesh before, where there are many optima.
const WIDER_BARRIER: f64 = 1e-4;
const WIDER_ITERATIONS: u32 = 300;

/// Ipopt's own barrier parameter at a cold start.
const LARGEST_BARRIER: f64 = 0.1;

/// Most solves on one mesh, should its solutions not be as was supposed.
const ATTEMPTS: u32 = 4;

/// What the solves on all meshes share.
pub(super) struct MeshSolver<'a> {
    pub ocp: &'a dyn DynOcp,
    pub settings: &'a nlp::Settings,
    /// Where the loop began.
    pub start: &'a Start,
    /// When all solves have to have ended.
    pub deadline: Deadline,
}

/// The solution of one programme.
pub(super) struct Solved {
    pub trajectory: Discretization,
    pub layout: Layout,
    pub iterate: Iterate,
    pub status: Status,
    pub objective: f64,
    pub nlp_iterations: u32,
    /// Whether no control is fixed on a bound that it had better leave.
    pub arcs_hold: bool,
}

impl Solved {
    /// Primal and dual values without what a structure adds.
    pub fn plain_iterate(&self) -> Iterate {
        self.layout.without_structure(&self.iterate)
    }
}

/// What the mesh before leaves to the next.
pub(super) struct Previous {
    pub solved: Solved,
    pub assessed: Assessed,
}

impl MeshSolver<'_> {
    /// Solves on the mesh of `trajectory`, again where the solution is not as was supposed of it.
    pub fn settled(
        &self,
        assumptions: &mut Assumptions<'_>,
        trajectory: &Discretization,
        structure: &Structure,
        previous: Option<&Previous>,
        statistics: &mut Statistics,
        monitor: &mut dyn FnMut(&Progress) -> Control,
    ) -> Result<Solved, ipopt::IpoptError> {
        let mut nlp_iterations = 0;
        for attempt in 1.. {
            let mesh = trajectory.mesh.clone();
            let formulation = assumptions.formulation();
            let mut program = Transcription::structured(
                self.ocp,
                formulation,
                assumptions.patterns(),
                mesh,
                structure.clone(),
            );
            let (mut settings, iterate) = self.warm_start(&program, trajectory, previous);
            settings.time_limit = self.deadline.remaining();
            let mut units = assumptions.units(program.layout());
            for (i, knot) in structure.knots.iter().enumerate() {
                units.variables[program.layout().knot(i)] = knot.unit();
            }
            if !structure.is_empty() {
                let most = settings.max_iterations.min(STRUCTURE_ITERATIONS);
                settings.max_iterations = most;
                settings.warm_start = settings.warm_start.map(|_| STRUCTURE_BARRIER);
            }
            let units = (!units.are_one()).then_some(units);
            let mut solved = self.solve(
                &mut program,
                units.as_ref(),
                settings,
                iterate,
                statistics,
                monitor,
            )?;
            nlp_iterations += solved.nlp_iterations;
            solved.nlp_iterations = nlp_iterations;
            let again = assumptions.settle(&solved.trajectory, solved.status);
            // Another attempt would end at the same limit.
            let spent = solved.status == Status::MaxIterations;
            if !again || attempt == ATTEMPTS || spent {
                return Ok(solved);
            }
        }
        unreachable!("the last attempt returns")
    }

    /// Settings and starting iterate of `program`: `trajectory` with the multipliers of the mesh
    /// before, or on the first mesh with those of the start, where there are any.
    fn warm_start(
        &self,
        program: &Transcription<'_>,
        trajectory: &Discretization,
        previous: Option<&Previous>,
    ) -> (nlp::Settings, Iterate) {
        let mut settings = self.settings.clone();
        let (mesh, layout) = (&trajectory.mesh, program.layout());
        let x = program.pack(trajectory);
        let iterate = match (previous, &self.start.iterate) {
            (
                Some(Previous {
                    solved: old,
                    assessed,
                }),
                _,
            ) => {
                let error = assessed.errors.max();
                settings.warm_start = Some(if error > ROUGH {
                    (ERROR_BARRIER * error).min(LARGEST_BARRIER)
                } else {
                    REFINED_BARRIER * settings.tolerance
                });
                Duals::new(&old.trajectory.mesh, &old.layout, &old.iterate).on(mesh, layout, x)
            }
            (None, Some(saved)) if settings.warm_start.is_some() => {
                match saved_layout(saved, layout) {
                    Some(old) if old == *layout => Iterate { x, ..saved.clone() },
                    Some(old) => Duals::new(mesh, &old, saved).on(mesh, layout, x),
                    None => Iterate::primal(x),
                }
            }
            _ => Iterate::primal(x),
        };
        if !iterate.has_multipliers(layout.rows()) {
            settings.warm_start = None;
        }
        (settings, iterate)
    }

    /// Solves `program` in `units`, or in its own, from `iterate`; should a warm start fail, again with a
    /// wider barrier, and then without multipliers.
    fn solve(
        &self,
        program: &mut Transcription<'_>,
        units: Option<&Units>,
        settings: nlp::Settings,
        iterate: Iterate,
        statistics: &mut Statistics,
        monitor: &mut dyn FnMut(&Progress) -> Control,
    ) -> Result<Solved, ipopt::IpoptError> {
        let mut spent = Duration::ZERO;
        let mut nlp_iterations = 0;
        let mut last = None;
        // Where a structure fails, the law has another mesh.
        let attempts = attempts(&settings, program.structure().is_empty());
        for attempt in attempts.into_iter().flatten() {
            // Multipliers may mislead; the same trajectory without them has every chance of
            // a cold start.
            let from = match attempt.barrier {
                Some(_) => iterate.clone(),
                None => Iterate::primal(iterate.x.clone()),
            };
            let settings = nlp::Settings {
                warm_start: attempt.barrier,
                max_iterations: attempt.iterations,
                time_limit: settings.time_limit.map(|limit| limit.saturating_sub(spent)),
                ..settings.clone()
            };
            let solution = in_units(program, units, &settings, &from, monitor)?;
            statistics.add(&solution.statistics);
            spent += solution.statistics.total;
            nlp_iterations += solution.statistics.iterations;
            let stopped = matches!(solution.status, Status::Interrupted | Status::TimeLimit);
            let ended = solution.status.is_solved() || stopped;
            last = Some(solution);
            if ended {
                break;
            }
        }
        let solution = last.expect("there is a first attempt");
        Ok(Solved {
            trajectory: program.unpack(&solution.iterate.x),
            layout: program.layout().clone(),
            arcs_hold: program.arcs_hold(&solution.iterate),
            iterate: solution.iterate,
            status: solution.status,
            objective: solution.objective,
            nlp_iterations,
        })
    }
}

/// One try to solve a programme.
struct Attempt {
    /// The barrier parameter of a warm start; a cold one without.
    barrier: Option<f64>,
    iterations: u32,
}

/// What is tried in turn with `settings`, once alone where it shall not be tried `again`. Who allows few
/// iterations has another start at hand.
fn attempts(settings: &nlp::Settings, again: bool) -> [Option<Attempt>; 3] {
    let allowed = settings.max_iterations;
    let attempt = |barrier, most: u32| Attempt {
        barrier,
        iterations: allowed.min(most),
    };
    match settings.warm_start {
        Some(barrier) if again => [
            Some(attempt(Some(barrier), WARM_ITERATIONS)),
            (barrier < WIDER_BARRIER && allowed > WARM_ITERATIONS)
                .then(|| attempt(Some(WIDER_BARRIER), WIDER_ITERATIONS)),
            Some(attempt(None, u32::MAX)),
        ],
        barrier => [Some(attempt(barrier, u32::MAX)), None, None],
    }
}

/// Solves `program` in `units`, where there are any; start and result are in its own.
fn in_units(
    program: &mut Transcription<'_>,
    units: Option<&Units>,
    settings: &nlp::Settings,
    start: &Iterate,
    monitor: &mut dyn FnMut(&Progress) -> Control,
) -> Result<nlp::Solution, ipopt::IpoptError> {
    let Some(units) = units else {
        return ipopt::solve(program, settings, start, monitor);
    };
    let mut scaled = Scaled::new(program, units);
    let mut solution = ipopt::solve(&mut scaled, settings, &units.scaled(start), monitor)?;
    solution.iterate = units.unscaled(&solution.iterate);
    for (value, unit) in solution.constraints.iter_mut().zip(&units.rows) {
        *value *= unit;
    }
    Ok(solution)
}
