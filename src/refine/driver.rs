//! Solves on one mesh after another until the error is within the tolerance.

use super::conditioning::Conditioning;
use super::transfer::{Duals, resample, saved_layout};
use super::violation::worst_of_each;
use super::{
    Assessment, Bounded, Errors, Record, Refined, RefinementLaw, Settings, SolveError, Verdict,
    Violation, midpoint_errors, quadrature_error, start_check, violations,
};
use crate::largest::largest;
use crate::nlp::{
    self, Control, Deadline, Iterate, Progress, Scaled, Statistics, Status, Units, ipopt,
};
use crate::ocp::{Interval, Ocp};
use crate::transcription::{Discretization, Layout, Patterns, Transcription};
use std::fmt;
use std::time::Instant;

/// Barrier parameter that a refined mesh starts with, as a part of the solver's tolerance: so far
/// below it that the first barrier problem is the last, and costs are as exact as from a cold start.
const REFINED_BARRIER: f64 = 0.1;

/// The same as a multiple of the error of the mesh before, where that is above [`ROUGH`]: far from
/// the solution a smaller barrier keeps the iterates at the wrong bounds.
const ERROR_BARRIER: f64 = 1e-5;
const ROUGH: f64 = 0.1;

/// Ipopt's own barrier parameter at a cold start.
const LARGEST_BARRIER: f64 = 0.1;

/// Meshes after the first on which the error may not fall for the refinement to diverge.
const GROWING: usize = 3;
/// Factor by which the cost then is larger at least.
const GROWTH: f64 = 1.2;
/// Error below which nothing diverges, in tolerances.
const COARSE: f64 = 100.0;
/// Error, in tolerances, above which a mesh says nothing of a motion.
const WILD: f64 = 1e5;

/// Part of its size by which a bound may be exceeded between the nodes of a mesh that counts.
const FAR: f64 = 0.05;

/// Most solves on one mesh, should its solutions not be as was supposed.
const ATTEMPTS: u32 = 4;

/// A step of the loop, for a monitor.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub enum Event<'a> {
    /// A mesh iteration begins.
    Mesh {
        /// Counted from 1.
        iteration: usize,
        /// Number of segments.
        segments: usize,
        /// Number of collocation points.
        points: usize,
    },
    /// An iteration of the solver on the current mesh.
    Solver(&'a Progress),
    /// A mesh iteration ended.
    Solved(&'a Record),
}

/// Where the loop starts from.
#[derive(Debug, Clone, PartialEq)]
pub struct Start {
    /// The first mesh and a trajectory on it.
    pub trajectory: Discretization,
    /// Multipliers that belong to the trajectory, for a warm start.
    pub iterate: Option<Iterate>,
}

/// Where the loop ended.
///
/// All but `discarded` and `statistics` belongs to one mesh iteration, that of the last of `records`.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Outcome {
    /// The trajectory on the mesh that counts.
    pub trajectory: Discretization,
    /// Its primal and dual values.
    pub iterate: Iterate,
    /// How its solve ended.
    pub status: Status,
    /// Its objective.
    pub objective: f64,
    /// One record a mesh iteration; the last is that of `trajectory`.
    pub records: Vec<Record>,
    /// Records of the mesh iterations after that one, which ended without a solution to be preferred:
    /// they were tried for the sake of bounds that are exceeded between the nodes and did not
    /// converge, or they were cut short.
    pub discarded: Vec<Record>,
    /// Whether the solve succeeded, the largest error is within the tolerance, and no bound is far
    /// exceeded between the nodes. Never where an error or a bounded row is NaN. The last record's
    /// [`Verdict`] says what is missing.
    pub converged: bool,
    /// Whether the time limit ended the refinement before it had converged.
    pub out_of_time: bool,
    /// The worst violation of every bound that is exceeded between the nodes by more than
    /// [`Settings::bound_tolerance`].
    pub violations: Vec<Violation>,
    /// Counts and times of all solves together, those of `discarded` included; barrier parameter
    /// and infeasibilities are those of the solve that counts.
    pub statistics: Statistics,
}

impl Outcome {
    /// Largest error (28) of the trajectory; NaN where the problem's rates are NaN.
    pub fn max_error(&self) -> f64 {
        self.records
            .last()
            .map_or(f64::INFINITY, |record| record.max_error)
    }

    /// This outcome, `later` being what came of the meshes after it.
    fn preferred_to(self, later: Self) -> Self {
        Self {
            discarded: later.records[self.records.len()..].to_vec(),
            out_of_time: later.out_of_time && !self.converged,
            statistics: Statistics {
                barrier: self.statistics.barrier,
                primal_infeasibility: self.statistics.primal_infeasibility,
                dual_infeasibility: self.statistics.dual_infeasibility,
                ..later.statistics
            },
            ..self
        }
    }
}

/// What the solve on one mesh starts from.
#[derive(Clone, Copy)]
struct From<'a> {
    trajectory: &'a Discretization,
    /// The solution on the mesh before.
    previous: Option<&'a Previous>,
    /// Where the loop began.
    start: &'a Start,
    /// When all solves have to have ended.
    deadline: Deadline,
}

/// The solution of one programme.
struct Solved {
    trajectory: Discretization,
    layout: Layout,
    iterate: Iterate,
    status: Status,
    objective: f64,
    nlp_iterations: u32,
}

/// What the mesh before leaves to the next.
struct Previous {
    solved: Solved,
    errors: Errors,
}

/// What a solution is worth.
struct Assessed {
    errors: Errors,
    /// Bounds exceeded between the nodes, by segments.
    outside: Vec<Vec<Violation>>,
    /// Those of `outside` that another mesh can mend.
    removable: Vec<Vec<Violation>>,
    verdict: Verdict,
}

/// One problem with its settings, ready to be solved on a sequence of meshes.
pub struct Refinement<'a, O: Ocp> {
    /// The problem.
    pub ocp: &'a O,
    /// Its sparsity.
    pub patterns: &'a Patterns,
    /// Mesh and refinement.
    pub settings: &'a Settings,
    /// The solver.
    pub solver: &'a nlp::Settings,
}

impl<O: Ocp> fmt::Debug for Refinement<'_, O> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Refinement")
            .field("settings", &self.settings)
            .field("solver", &self.solver)
            .finish_non_exhaustive()
    }
}

impl<O: Ocp> Refinement<'_, O> {
    /// A straight line between the ends of every state on the first mesh, at rest controls.
    ///
    /// # Errors
    /// Where the settings give no mesh.
    pub fn straight_start(&self) -> Result<Start, crate::collocation::MeshError> {
        let formulation = self.ocp.formulation();
        let fractions = formulation.way_point_fractions();
        let mesh = self.settings.first_mesh()?.through(&fractions)?;
        let (states, controls) = formulation.widths();
        let duration = formulation.duration.typical();
        let trajectory = Discretization::sample(mesh, duration, states, controls, |part, x, u| {
            for (i, value) in x.iter_mut().enumerate() {
                let bounds = &formulation.states[i].bounds;
                let ends = [&formulation.initial[i], &formulation.terminal[i]];
                let [start, end] = line(ends.map(|end| end.intersect(bounds)), ends);
                *value = start + part * (end - start);
            }
            for (value, control) in u.iter_mut().zip(&formulation.controls) {
                *value = control.bounds.clamp(0.0);
            }
        });
        Ok(Start {
            trajectory,
            iterate: None,
        })
    }

    /// Solves on the start's mesh, with a breakpoint at every way-point, then on refined ones.
    ///
    /// Meshes follow while the error is above the tolerance, and while a state or a path row of the
    /// states exceeds its bounds between the nodes; should a mesh for the sake of the latter fail,
    /// the last one that converged counts.
    ///
    /// The monitor is told of each step and can stop the loop, and so does the solver's time limit,
    /// which is one for all meshes together. Where they cut a solve short, the last mesh that was
    /// solved counts. A failed solve ends the loop; the outcome then holds the last trajectory all
    /// the same.
    ///
    /// # Errors
    /// [`SolveError`]: a formulation or a start that cannot be, an output that is never written, and
    /// what the solver refuses before it begins.
    pub fn run(
        &self,
        start: &Start,
        monitor: &mut dyn FnMut(Event<'_>) -> Control,
    ) -> Result<Outcome, SolveError> {
        let formulation = self.ocp.formulation();
        formulation.validate()?;
        let found = (start.trajectory.states, start.trajectory.controls);
        if found != formulation.widths() {
            let expected = formulation.widths();
            return Err(SolveError::Start { found, expected });
        }
        let law = self.settings.law();
        let deadline = Deadline::after(self.solver.time_limit);
        let mut records: Vec<Record> = Vec::new();
        let mut statistics = Statistics::default();
        let mut trajectory = self.at_way_points(&start.trajectory);
        start_check::written(self.ocp, &formulation, &trajectory)?;
        let mut conditioning = Conditioning::new(self.ocp, self.patterns, &trajectory);
        let mut previous: Option<Previous> = None;
        let mut best: Option<Outcome> = None;
        loop {
            let began = Instant::now();
            let iteration = records.len() + 1;
            let event = Event::Mesh {
                iteration,
                segments: trajectory.mesh.segments(),
                points: trajectory.mesh.points(),
            };
            let stopped = monitor(event) == Control::Stop;
            let from = From {
                trajectory: &trajectory,
                previous: previous.as_ref(),
                start,
                deadline,
            };
            let solved = self.settled(&mut conditioning, from, &mut statistics, &mut |p| {
                if stopped {
                    Control::Stop
                } else {
                    monitor(Event::Solver(p))
                }
            })?;
            let assessed = self.assess(&solved, &conditioning);
            records.push(self.record(&solved, &assessed, began));
            if self.diverges(&records) {
                records[iteration - 1].verdict = Verdict::Diverging;
            }
            let ended = !solved.status.is_solved()
                || records[iteration - 1].verdict == Verdict::Diverging
                || law.is_last(&records);
            let next = (!ended)
                .then(|| {
                    let trajectory = conditioning.in_units(&solved.trajectory, self.settings);
                    refined(&*law, &trajectory, &assessed, previous.as_ref())
                })
                .flatten();
            records[iteration - 1].decisions = next
                .as_ref()
                .map_or_else(Vec::new, |next| next.decisions.clone());
            let halt = monitor(Event::Solved(&records[iteration - 1])) == Control::Stop;
            let late = deadline.has_passed();
            let outcome = Outcome {
                trajectory: solved.trajectory.clone(),
                iterate: solved.iterate.clone(),
                status: solved.status,
                objective: solved.objective,
                records: records.clone(),
                discarded: Vec::new(),
                converged: records[iteration - 1].verdict.is_converged(),
                out_of_time: solved.status == Status::TimeLimit || (late && next.is_some()),
                violations: worst_of_each(&assessed.outside, self.settings.bound_tolerance),
                statistics,
            };
            match next.filter(|_| !halt && !late) {
                Some(next) => {
                    trajectory = resample(&solved.trajectory, next.mesh);
                    previous = Some(Previous {
                        solved,
                        errors: assessed.errors,
                    });
                    if outcome.converged || best.as_ref().is_none_or(|best| !best.converged) {
                        best = Some(outcome);
                    }
                }
                None => {
                    let cut_short =
                        matches!(outcome.status, Status::Interrupted | Status::TimeLimit);
                    return Ok(match best {
                        Some(best) if best.converged && !outcome.converged || cut_short => {
                            best.preferred_to(outcome)
                        }
                        _ => outcome,
                    });
                }
            }
        }
    }

    /// Whether no mesh has a smaller error than the first, far above the tolerance, and the cost has
    /// grown: over several meshes, or over two where the error is larger than any motion's.
    fn diverges(&self, records: &[Record]) -> bool {
        let tolerance = self.settings.tolerance;
        let wild = records[0].max_error > WILD * tolerance;
        if records.len() <= if wild { 1 } else { GROWING } {
            return false;
        }
        let growth = if wild { 2.0 } else { GROWTH };
        let (first, later) = (&records[0], &records[1..]);
        let rough = |record: &Record| record.max_error >= first.max_error;
        first.max_error > COARSE * tolerance
            && later.iter().all(rough)
            && later[later.len() - 1].objective > growth * first.objective.abs()
    }

    /// Solves on the mesh of `from`, again where the solution is not as was supposed of it.
    fn settled(
        &self,
        conditioning: &mut Conditioning<'_, O>,
        from: From<'_>,
        statistics: &mut Statistics,
        monitor: &mut dyn FnMut(&Progress) -> Control,
    ) -> Result<Solved, ipopt::IpoptError> {
        let mut nlp_iterations = 0;
        for attempt in 1.. {
            let mesh = from.trajectory.mesh.clone();
            let formulation = conditioning.formulation();
            let mut program =
                Transcription::within(self.ocp, formulation, conditioning.patterns(), mesh);
            let (mut settings, iterate) = self.warm_start(&program, from);
            settings.time_limit = from.deadline.remaining();
            let units = conditioning.units(program.layout());
            let mut solved =
                self.solve(&mut program, &units, settings, iterate, statistics, monitor)?;
            nlp_iterations += solved.nlp_iterations;
            solved.nlp_iterations = nlp_iterations;
            let again = conditioning.settle(&solved.trajectory, solved.status);
            if !again || attempt == ATTEMPTS {
                return Ok(solved);
            }
        }
        unreachable!("the last attempt returns")
    }

    /// Settings and starting iterate of `program`: `trajectory` with the multipliers of the mesh
    /// before, or on the first mesh with those of the start, where there are any.
    fn warm_start(
        &self,
        program: &Transcription<'_, O>,
        from: From<'_>,
    ) -> (nlp::Settings, Iterate) {
        let From {
            trajectory,
            previous,
            start,
            ..
        } = from;
        let mut settings = self.solver.clone();
        let (mesh, layout) = (&trajectory.mesh, program.layout());
        let x = program.pack(trajectory);
        let iterate = match (previous, &start.iterate) {
            (
                Some(Previous {
                    solved: old,
                    errors,
                }),
                _,
            ) => {
                let error = errors.max();
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

    /// Solves `program` in `units` from `iterate`, and should a warm start fail, once more without multipliers.
    fn solve(
        &self,
        program: &mut Transcription<'_, O>,
        units: &Units,
        mut settings: nlp::Settings,
        iterate: Iterate,
        statistics: &mut Statistics,
        monitor: &mut dyn FnMut(&Progress) -> Control,
    ) -> Result<Solved, ipopt::IpoptError> {
        let mut solution = in_units(program, units, &settings, &iterate, monitor)?;
        statistics.add(&solution.statistics);
        let mut nlp_iterations = solution.statistics.iterations;
        let stopped = matches!(solution.status, Status::Interrupted | Status::TimeLimit);
        let gave_up = !solution.status.is_solved() && !stopped;
        if gave_up && settings.warm_start.take().is_some() {
            // Multipliers may mislead; the same trajectory without them has every chance of
            // a cold start.
            let spent = solution.statistics.total;
            settings.time_limit = settings.time_limit.map(|limit| limit.saturating_sub(spent));
            let primal = Iterate::primal(iterate.x);
            solution = in_units(program, units, &settings, &primal, monitor)?;
            statistics.add(&solution.statistics);
            nlp_iterations += solution.statistics.iterations;
        }
        Ok(Solved {
            trajectory: program.unpack(&solution.iterate.x),
            layout: program.layout().clone(),
            iterate: solution.iterate,
            status: solution.status,
            objective: solution.objective,
            nlp_iterations,
        })
    }

    /// Looks at a solution between its nodes.
    fn assess(&self, solved: &Solved, conditioning: &Conditioning<'_, O>) -> Assessed {
        let errors = midpoint_errors(self.ocp, &solved.trajectory);
        let errors = conditioning.measured(errors, self.settings);
        let max_error = errors.max();
        let accurate = max_error <= self.settings.tolerance;
        let outside = violations(self.ocp, &solved.trajectory);
        let removable = self.removable(&outside);
        let farthest = FAR.max(self.settings.bound_tolerance);
        let undefined = max_error.is_nan() || outside.iter().flatten().any(|v| v.value.is_nan());
        let verdict = if !solved.status.is_solved() {
            Verdict::NotSolved(solved.status)
        } else if undefined {
            Verdict::Undefined
        } else if !accurate {
            Verdict::AboveTolerance
        } else if removable.iter().flatten().all(|v| v.relative <= farthest) {
            Verdict::Converged
        } else {
            Verdict::BoundExceeded
        };
        Assessed {
            errors,
            outside,
            removable,
            verdict,
        }
    }

    fn record(&self, solved: &Solved, assessed: &Assessed, began: Instant) -> Record {
        let mesh = &solved.trajectory.mesh;
        let outside = assessed.outside.iter().flatten();
        Record {
            points: mesh.points(),
            segments: mesh.segments(),
            breakpoints: mesh.breakpoints().to_vec(),
            quadrature_error: quadrature_error(self.ocp, &solved.trajectory),
            segment_errors: assessed.errors.by_segment.clone(),
            max_error: assessed.errors.max(),
            max_violation: largest(outside.map(|v| v.relative)),
            objective: solved.objective,
            nlp_iterations: solved.nlp_iterations,
            nlp_status: solved.status,
            verdict: assessed.verdict,
            time: began.elapsed(),
            decisions: Vec::new(),
        }
    }

    /// The violations that another mesh removes: those of states and of rows of the states. A row
    /// of the controls overshoots where these switch, however narrow the segment.
    fn removable(&self, outside: &[Vec<Violation>]) -> Vec<Vec<Violation>> {
        let formulation = self.ocp.formulation();
        let removable = |violation: &&Violation| match violation.what {
            Bounded::State(_) => true,
            Bounded::Path(p) => self.patterns.path_is_continuous(&formulation, p),
        };
        outside
            .iter()
            .map(|segment| segment.iter().filter(removable).copied().collect())
            .collect()
    }

    /// The trajectory on a mesh with a breakpoint at every way-point; as it is where its mesh has
    /// them all.
    fn at_way_points(&self, start: &Discretization) -> Discretization {
        let fractions = self.ocp.formulation().way_point_fractions();
        let mesh = start.mesh.through(&fractions);
        let mesh = mesh.expect("way-points rise between the ends");
        if mesh == start.mesh {
            start.clone()
        } else {
            resample(start, mesh)
        }
    }
}

/// Solves `program` in `units`; start and result are in its own.
fn in_units<O: Ocp>(
    program: &mut Transcription<'_, O>,
    units: &Units,
    settings: &nlp::Settings,
    start: &Iterate,
    monitor: &mut dyn FnMut(&Progress) -> Control,
) -> Result<nlp::Solution, ipopt::IpoptError> {
    if units.are_one() {
        return ipopt::solve(program, settings, start, monitor);
    }
    let mut scaled = Scaled::new(program, units);
    let mut solution = ipopt::solve(&mut scaled, settings, &units.scaled(start), monitor)?;
    solution.iterate = units.unscaled(&solution.iterate);
    for (value, unit) in solution.constraints.iter_mut().zip(&units.rows) {
        *value *= unit;
    }
    Ok(solution)
}

/// Ends of a straight line within `ends`, the bounds along the path included; `instants` are those
/// of the ends alone. What is open at one end stays as it is at the other.
fn line(ends: [Interval; 2], instants: [&Interval; 2]) -> [f64; 2] {
    let meant = |k: usize| {
        let (end, instant) = (ends[k], instants[k]);
        let both = instant.lower.is_finite() && instant.upper.is_finite();
        (end.is_fixed() || both).then(|| end.center())
    };
    match [meant(0), meant(1)] {
        [Some(start), Some(end)] => [start, end],
        [Some(start), None] => [start, ends[1].clamp(start)],
        [None, Some(end)] => [ends[0].clamp(end), end],
        [None, None] => ends.map(|end| end.clamp(0.0)),
    }
}

/// The next mesh by `law`, `trajectory` being in the units of the errors.
fn refined(
    law: &dyn RefinementLaw,
    trajectory: &Discretization,
    assessed: &Assessed,
    previous: Option<&Previous>,
) -> Option<Refined> {
    law.refine(&Assessment {
        trajectory,
        errors: &assessed.errors,
        before: previous.map(|old| (&old.solved.trajectory.mesh, &old.errors)),
        violations: &assessed.removable,
    })
}
