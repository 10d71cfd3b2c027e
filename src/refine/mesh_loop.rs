//! The loop over meshes: one solve and one decision of the law a step.

use super::assess::{Assessed, Assessor};
use super::assumptions::Assumptions;
use super::divergence::diverges;
use super::mesh_solve::{MeshSolver, Previous, Solved};
use super::transfer::resample;
use super::violation::worst_of_each;
use super::{
    Assessment, CutShort, Event, Facts, Method, Outcome, Record, Refined, RefinementLaw, Settings,
    SolveError, Verdict, quadrature_error,
};
use crate::nlp::{Control, Progress, Statistics, Status};
use crate::numeric::largest_or_nan;
use crate::transcription::{Discretization, Patterns, Structure};
use std::time::Instant;

/// Part of the error before to which a mesh with a structure has to bring it: the right structure does
/// so by decades.
const STRUCTURE_PROGRESS: f64 = 0.2;

/// What the loop knows between two meshes.
pub(super) struct MeshLoop<'a> {
    settings: &'a Settings,
    law: Box<dyn RefinementLaw + 'a>,
    facts: &'a Facts<'a>,
    solver: MeshSolver<'a>,
    assessor: Assessor<'a>,
    assumptions: Assumptions<'a>,
    /// What the next solve starts from, on its mesh.
    trajectory: Discretization,
    /// What is supposed of its solution.
    structure: Structure,
    /// Whether a structure has not held before.
    structure_failed: bool,
    records: Vec<Record>,
    /// Those of `records` without the meshes whose structure did not hold.
    accepted: Vec<Record>,
    /// The last mesh that was accepted.
    previous: Option<Previous>,
    /// The best mesh before: what counts where the later ones fail, or are worse.
    best: Option<Outcome>,
    statistics: Statistics,
}

/// One mesh iteration.
struct Round {
    solved: Solved,
    assessed: Assessed,
    /// Whether the solution contradicts the structure it was made with. That is no reason to end: the
    /// law goes on from the mesh before.
    rejected: bool,
}

impl<'a> MeshLoop<'a> {
    /// Begins with `trajectory`: the solver's start with a node at every way-point.
    pub fn new(
        solver: MeshSolver<'a>,
        patterns: &'a Patterns,
        settings: &'a Settings,
        facts: &'a Facts<'a>,
        trajectory: Discretization,
    ) -> Self {
        let ocp = solver.ocp;
        Self {
            settings,
            law: settings.law(),
            solver,
            assessor: Assessor::new(ocp, &facts.jumping_rows, settings),
            assumptions: Assumptions::new(ocp, patterns, &trajectory),
            facts,
            trajectory,
            structure: Structure::default(),
            structure_failed: false,
            records: Vec::new(),
            accepted: Vec::new(),
            previous: None,
            best: None,
            statistics: Statistics::default(),
        }
    }

    /// Solves on the next mesh and lets the law choose the one after. The outcome where the loop ends with
    /// it.
    pub fn step(
        &mut self,
        monitor: &mut dyn FnMut(Event<'_>) -> Control,
    ) -> Result<Option<Outcome>, SolveError> {
        let (round, mut record) = self.solve(monitor)?;
        if !round.rejected {
            self.accepted.push(record.clone());
            if diverges(&self.accepted, self.settings.tolerance) {
                record.verdict = Verdict::Diverging;
            }
        }
        self.records.push(record);
        let next = match self.is_last(&round) {
            true => None,
            false => self.next_mesh(&round),
        };
        let record = self.records.last_mut().expect("one was added just now");
        if let Some(next) = &next {
            record.decisions.clone_from(&next.decisions);
        }
        let stopped = monitor(Event::Solved(record)) == Control::Stop;
        let late = self.solver.deadline.has_passed();
        let cut_short = match round.solved.status {
            Status::Interrupted => Some(CutShort::Interrupted),
            Status::TimeLimit => Some(CutShort::OutOfTime),
            _ if next.is_none() => None,
            _ if stopped => Some(CutShort::Interrupted),
            _ => late.then_some(CutShort::OutOfTime),
        };
        let outcome = self.outcome(&round, cut_short);
        Ok(match next.filter(|_| !stopped && !late) {
            Some(next) => {
                self.advance(round, next, outcome);
                None
            }
            None => Some(self.finish(round.rejected, outcome)),
        })
    }

    /// Solves on the current mesh and looks at the solution.
    fn solve(
        &mut self,
        monitor: &mut dyn FnMut(Event<'_>) -> Control,
    ) -> Result<(Round, Record), SolveError> {
        let began = Instant::now();
        let mesh = &self.trajectory.mesh;
        let event = Event::Mesh {
            iteration: self.records.len() + 1,
            segments: mesh.segments(),
            points: mesh.points(),
        };
        let stopped = monitor(event) == Control::Stop;
        let mut on_step = |progress: &Progress| match stopped {
            true => Control::Stop,
            false => monitor(Event::Solver(progress)),
        };
        let solved = self.solver.settled(
            &mut self.assumptions,
            &self.trajectory,
            &self.structure,
            self.previous.as_ref(),
            &mut self.statistics,
            &mut on_step,
        )?;
        let assessed = self.assessor.assess(&solved, &self.assumptions);
        let record = self.record(&solved, &assessed, began);
        let cut_short = matches!(solved.status, Status::Interrupted | Status::TimeLimit);
        let holds = solved.status.is_solved() && solved.arcs_hold && self.gains(&assessed);
        let rejected = !(self.structure.is_empty() || cut_short || holds);
        self.structure_failed |= rejected;
        let round = Round {
            solved,
            assessed,
            rejected,
        };
        Ok((round, record))
    }

    /// Whether no mesh comes after `round`, whatever the law has in mind.
    fn is_last(&self, round: &Round) -> bool {
        let count = self.records.len();
        // Meshes whose structure did not hold are unknown to the law.
        let most = self.settings.max_iterations;
        let most = most.filter(|_| self.structure_failed);
        !(round.solved.status.is_solved() || round.rejected)
            || self.records[count - 1].verdict == Verdict::Diverging
            || most.is_some_and(|most| count >= most)
            || self.law.is_last(&self.accepted)
    }

    /// The mesh after `round`, or after the one before where `round` was rejected.
    fn next_mesh(&self, round: &Round) -> Option<Refined> {
        let previous = self.previous.as_ref();
        let (solved, assessed, before) = match previous.filter(|_| round.rejected) {
            Some(old) => (&old.solved, &old.assessed, None),
            None => (&round.solved, &round.assessed, previous),
        };
        let trajectory = self.assumptions.in_units(&solved.trajectory, self.settings);
        self.law.refine(&Assessment {
            trajectory: &trajectory,
            errors: &assessed.errors,
            before: before.map(|o| (&o.solved.trajectory.mesh, &o.assessed.errors)),
            violations: &assessed.removable,
            solution: &solved.trajectory,
            structure: &self.structure,
            structure_failed: self.structure_failed,
            facts: Some(self.facts),
            tolerance: assessed.next_tolerance,
        })
    }

    /// What it would come to if the loop ended with `round`.
    fn outcome(&self, round: &Round, cut_short: Option<CutShort>) -> Outcome {
        let solved = &round.solved;
        let verdict = self.records.last().map(|record| record.verdict);
        Outcome {
            trajectory: solved.trajectory.clone(),
            iterate: solved.plain_iterate(),
            status: solved.status,
            objective: solved.objective,
            records: self.records.clone(),
            discarded: Vec::new(),
            converged: !round.rejected && verdict.is_some_and(|verdict| verdict.is_converged()),
            cut_short,
            violations: worst_of_each(&round.assessed.outside, self.settings.bound_tolerance),
            released: Vec::new(),
            statistics: self.statistics,
        }
    }

    /// Goes on to the mesh `next`.
    fn advance(&mut self, round: Round, next: Refined, outcome: Outcome) {
        self.structure = next.structure;
        if let Some(old) = self.previous.as_ref().filter(|_| round.rejected) {
            self.trajectory = resample(&old.solved.trajectory, next.mesh);
            return;
        }
        self.trajectory = resample(&round.solved.trajectory, next.mesh);
        self.previous = Some(Previous {
            solved: round.solved,
            assessed: round.assessed,
        });
        let worse = |best: &Outcome| !best.converged && !best.is_nearer_than(&outcome);
        if outcome.converged || self.best.as_ref().is_none_or(worse) {
            self.best = Some(outcome);
        }
    }

    /// The last outcome, or the best before where the last is no better.
    fn finish(&mut self, rejected: bool, outcome: Outcome) -> Outcome {
        let failed = !outcome.status.is_solved();
        // Of errors that lead nowhere the last says so; the first are no smaller for being right. The
        // global method is measured by where it comes to.
        let last = outcome.records.last().map(|record| record.verdict);
        let last_counts =
            last == Some(Verdict::Diverging) || self.settings.method == Method::Global;
        let is_better = |best: &mut Outcome| {
            !outcome.converged
                && (rejected
                    || best.converged
                    || failed && (outcome.cut_short.is_some() || best.is_accurate())
                    || !failed && !last_counts && best.is_nearer_than(&outcome))
        };
        match self.best.take_if(is_better) {
            Some(best) => best.preferred_to(outcome),
            None => outcome,
        }
    }

    /// Whether a mesh with a structure is as good as it should be.
    fn gains(&self, assessed: &Assessed) -> bool {
        let before = self.previous.as_ref();
        let before = before.map_or(f64::INFINITY, |old| old.assessed.errors.max());
        assessed.errors.max() <= self.settings.tolerance.max(STRUCTURE_PROGRESS * before)
    }

    fn record(&self, solved: &Solved, assessed: &Assessed, began: Instant) -> Record {
        let mesh = &solved.trajectory.mesh;
        let outside = assessed.outside.iter().flatten();
        Record {
            points: mesh.points(),
            segments: mesh.segments(),
            breakpoints: mesh.breakpoints().to_vec(),
            quadrature_error: quadrature_error(self.solver.ocp, &solved.trajectory),
            segment_errors: assessed.errors.by_segment.clone(),
            max_error: assessed.errors.max(),
            max_violation: largest_or_nan(outside.map(|v| v.relative)),
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
}
