//! Solves on one mesh after another until the error is within the tolerance.

use super::assess::{Assessed, Assessor};
use super::conditioning::Conditioning;
use super::mesh_solve::{MeshSolver, Previous, Solved};
use super::start::straight;
use super::transfer::resample;
use super::violation::worst_of_each;
use super::{
    Assessment, CutShort, Facts, Outcome, Record, Settings, SolveError, Start, Verdict,
    quadrature_error, start_check,
};
use crate::largest::largest;
use crate::nlp::{self, Control, Deadline, Progress, Statistics, Status};
use crate::ocp::DynOcp;
use crate::transcription::{Discretization, Patterns, Structure, integrals};
use std::fmt;
use std::time::Instant;

/// Meshes after the first on which the error may not fall for the refinement to diverge.
const GROWING: usize = 3;
/// Factor by which the cost then is larger at least.
const GROWTH: f64 = 1.2;
/// Error below which nothing diverges.
const COARSE: f64 = 1e-3;
/// Error above which a mesh says nothing of a motion.
const WILD: f64 = 1.0;
/// Meshes after the first that tell of a divergence then, if the error rises from each to the next, and
/// factor by which the cost is larger at least on the last: that of the first alone may be far too
/// low.
const GROWING_WILDLY: usize = 2;
const WILD_GROWTH: f64 = 2.0;

/// Part of the error before to which a mesh with a structure has to bring it: the right structure does
/// so by decades.
const STRUCTURE_PROGRESS: f64 = 0.2;

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

/// One problem with its settings, ready to be solved on a sequence of meshes.
pub struct Refinement<'a> {
    /// The problem.
    pub ocp: &'a dyn DynOcp,
    /// Its sparsity.
    pub patterns: &'a Patterns,
    /// Mesh and refinement.
    pub settings: &'a Settings,
    /// The solver.
    pub solver: &'a nlp::Settings,
}

impl fmt::Debug for Refinement<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Refinement")
            .field("settings", &self.settings)
            .field("solver", &self.solver)
            .finish_non_exhaustive()
    }
}

impl Refinement<'_> {
    /// A straight line between the ends of every state on the first mesh, at rest controls.
    ///
    /// # Errors
    /// Where the settings give no mesh.
    pub fn straight_start(&self) -> Result<Start, crate::collocation::MeshError> {
        let formulation = self.ocp.formulation();
        let fractions = formulation.way_point_fractions();
        let mesh = self.settings.first_mesh()?.through(&fractions)?;
        Ok(Start {
            trajectory: straight(&formulation, mesh),
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
        let mut trajectory = self.begun(&start.trajectory)?;
        let law = self.settings.law();
        let deadline = Deadline::after(self.solver.time_limit);
        let mut records: Vec<Record> = Vec::new();
        let mut statistics = Statistics::default();
        let mut conditioning = Conditioning::new(self.ocp, self.patterns, &trajectory);
        let solver = MeshSolver {
            ocp: self.ocp,
            settings: self.solver,
            start,
            deadline,
        };
        let assessor = Assessor::new(self.ocp, self.patterns, self.settings);
        let formulation = self.ocp.formulation();
        let facts = Facts::of(self.ocp, &formulation, self.patterns);
        let mut structure = Structure::default();
        let mut structure_failed = false;
        // Records without those of structures that did not hold.
        let mut counted: Vec<Record> = Vec::new();
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
            let before = previous.as_ref();
            let mut on_step = |progress: &Progress| match stopped {
                true => Control::Stop,
                false => monitor(Event::Solver(progress)),
            };
            let solved = solver.settled(
                &mut conditioning,
                &trajectory,
                &structure,
                before,
                &mut statistics,
                &mut on_step,
            )?;
            let assessed = assessor.assess(&solved, &conditioning);
            records.push(self.record(&solved, &assessed, began));
            // A structure that does not hold is no reason to end: the mesh before counts.
            let stopped = matches!(solved.status, Status::Interrupted | Status::TimeLimit);
            let holds = solved.status.is_solved()
                && solved.arcs_hold
                && self.gains(&assessed, previous.as_ref());
            let fell = !(structure.is_empty() || stopped || holds);
            structure_failed |= fell;
            if !fell {
                counted.push(records[iteration - 1].clone());
                if self.diverges(&counted) {
                    records[iteration - 1].verdict = Verdict::Diverging;
                }
            }
            let most = (self.settings.max_iterations).filter(|_| structure_failed);
            let ended = !(solved.status.is_solved() || fell)
                || records[iteration - 1].verdict == Verdict::Diverging
                || most.is_some_and(|most| records.len() >= most)
                || law.is_last(&counted);
            let next = (!ended)
                .then(|| {
                    let (solved, assessed, before) = match previous.as_ref().filter(|_| fell) {
                        Some(old) => (&old.solved, &old.assessed, None),
                        None => (&solved, &assessed, previous.as_ref()),
                    };
                    let trajectory = conditioning.in_units(&solved.trajectory, self.settings);
                    law.refine(&Assessment {
                        trajectory: &trajectory,
                        errors: &assessed.errors,
                        before: before.map(|o| (&o.solved.trajectory.mesh, &o.assessed.errors)),
                        violations: &assessed.removable,
                        solution: &solved.trajectory,
                        structure: &structure,
                        structure_failed,
                        facts: Some(&facts),
                        tolerance: assessed.next_tolerance,
                    })
                })
                .flatten();
            records[iteration - 1].decisions = next
                .as_ref()
                .map_or_else(Vec::new, |next| next.decisions.clone());
            let halt = monitor(Event::Solved(&records[iteration - 1])) == Control::Stop;
            let late = deadline.has_passed();
            let outcome = Outcome {
                trajectory: solved.trajectory.clone(),
                iterate: solved.plain_iterate(),
                status: solved.status,
                objective: solved.objective,
                records: records.clone(),
                discarded: Vec::new(),
                converged: !fell && records[iteration - 1].verdict.is_converged(),
                cut_short: match solved.status {
                    Status::Interrupted => Some(CutShort::Interrupted),
                    Status::TimeLimit => Some(CutShort::OutOfTime),
                    _ if next.is_none() => None,
                    _ if halt => Some(CutShort::Interrupted),
                    _ => late.then_some(CutShort::OutOfTime),
                },
                violations: worst_of_each(&assessed.outside, self.settings.bound_tolerance),
                released: Vec::new(),
                statistics,
            };
            match next.filter(|_| !halt && !late) {
                Some(next) => {
                    structure = next.structure;
                    if let Some(old) = previous.as_ref().filter(|_| fell) {
                        trajectory = resample(&old.solved.trajectory, next.mesh);
                        continue;
                    }
                    trajectory = resample(&solved.trajectory, next.mesh);
                    previous = Some(Previous { solved, assessed });
                    if outcome.converged || best.as_ref().is_none_or(|best| !best.converged) {
                        best = Some(outcome);
                    }
                }
                None => {
                    let failed = !outcome.status.is_solved();
                    let worse = |best: &Outcome| {
                        !outcome.converged
                            && (fell
                                || best.converged
                                || failed && (outcome.cut_short.is_some() || best.is_accurate()))
                    };
                    return Ok(match best.take_if(|best| worse(best)) {
                        Some(best) => best.preferred_to(outcome),
                        None => outcome,
                    });
                }
            }
        }
    }

    /// Whether a mesh with a structure is as good as it should be.
    fn gains(&self, assessed: &Assessed, previous: Option<&Previous>) -> bool {
        let before = previous.map_or(f64::INFINITY, |old| old.assessed.errors.max());
        let most = self.settings.tolerance.max(STRUCTURE_PROGRESS * before);
        assessed.errors.max() <= most
    }

    /// Whether no mesh has a smaller error than the first, far above the tolerance, and the cost has
    /// grown: over several meshes, or over fewer where the error is larger than any motion's and
    /// rises.
    fn diverges(&self, records: &[Record]) -> bool {
        let (first, later) = (&records[0], &records[1..]);
        let rough = |record: &Record| record.max_error >= first.max_error;
        let solved = |record: &Record| record.nlp_status.is_solved();
        let grows = |from: &Record, to: &Record, by: f64| to.objective > by * from.objective.abs();
        if !records.iter().all(solved)
            || !later.iter().all(rough)
            || first.max_error <= COARSE.max(self.settings.tolerance)
        {
            return false;
        }
        let Some(last) = later.last() else {
            return false;
        };
        let mut pairs = records.windows(2);
        let is_wild = first.max_error > WILD
            && later.len() >= GROWING_WILDLY
            && pairs.all(|pair| pair[1].max_error > pair[0].max_error);
        let is_long = later.len() >= GROWING;
        is_wild && grows(first, last, WILD_GROWTH) || is_long && grows(first, last, GROWTH)
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
            removable_violation: assessed.left_to_remove,
            objective: solved.objective,
            objective_error: assessed.objective_error,
            nlp_iterations: solved.nlp_iterations,
            nlp_status: solved.status,
            verdict: assessed.verdict,
            time: began.elapsed(),
            decisions: Vec::new(),
        }
    }

    /// `start` as the loop begins with it: of this problem, with a node at every way-point and the
    /// integrals that it has.
    fn begun(&self, start: &Discretization) -> Result<Discretization, SolveError> {
        let formulation = self.ocp.formulation();
        formulation.validate()?;
        let (found, expected) = ((start.states, start.controls), formulation.widths());
        if found != expected {
            return Err(SolveError::Start { found, expected });
        }
        let (found, expected) = (start.parameters.len(), formulation.parameters.len());
        if found != expected {
            return Err(SolveError::StartParameters { found, expected });
        }
        let mut trajectory = self.at_way_points(start);
        trajectory.initial_time = formulation.initial_time.clamp(trajectory.initial_time);
        start_check::written(self.ocp, &formulation, &trajectory)?;
        trajectory.integrals = integrals(self.ocp, &formulation, &trajectory);
        Ok(trajectory)
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
