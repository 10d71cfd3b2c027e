//! The least excess of elastic limits: searched from many starts on one mesh, then refined.
//!
//! On one mesh a programme may find an excess that no motion has, by moving between the points where
//! nothing is asked. So a result counts as found only where its refinement converged, and the control
//! has a weight, which falls from one refined solution to the next.

use super::candidates::{Candidate, Candidates, GROSS, Look};
use super::findings::findings;
use crate::collocation::Mesh;
use crate::dynamics::space::Space;
use crate::nlp::{self, Control, Deadline, Statistics};
use crate::ocp::{Elastic, LimitGroup, Ocp};
use crate::planner::collocation::elastic_trajectory::{extend, strip};
use crate::planner::{Event, LimitFinding, PlanError, StartCounts};
use crate::problem::Problem;
use crate::refine::{self, CutShort, Law, Method, Outcome, Refinement, Start};
use crate::system::{self, ElasticLimit, FreeFloating, JointPath, along};
use crate::transcription::{Discretization, Patterns};

/// How many of the best starts are refined, and how many are tried where others do not converge.
const REFINED: usize = 2;
const TRIED: usize = 5;
/// Iterations of one solve of a search, and of one in the refinement; fewer where the solver's limit
/// is lower.
pub(super) const ITERATIONS: [u32; 2] = [300, 150];
/// Part to which a gross error falls on the next mesh at least where a motion comes of it.
const FALLS: f64 = 0.5;
/// Weight of the problem's own cost, so that the least relaxation is not degenerate.
const REGULARIZATION: f64 = 1e-5;
/// The search that is always made. Starts: the failed trajectory, the straight path, and paths with loops
/// and detours. Weights of the control are parts of the excess along the straight path that the least
/// control from start to goal costs. The larger weight keeps motions smooth. The smaller finds those that
/// need much control: several loops, between whose points a coarse mesh would hide what no motion can.
const FIRST_LOOK: Look = Look {
    seed: 1,
    starts: 8,
    patience: 5,
    tighter: 0.0,
    searched: &[(1e-4, 1), (1e-6, 2)],
    first_weight: 5.0,
};
/// A closer one. Limits are tighter by a part of themselves, so that nothing is flat where they would hold,
/// and what starts end at can be compared. What differs by little is told apart on a finer mesh alone.
const CLOSER_LOOK: Look = Look {
    seed: 2,
    starts: 10,
    patience: 6,
    tighter: 0.375,
    searched: &[(1e-6, 4)],
    first_weight: 1.0,
};
/// Weights of the control in the refinement, one after another.
const WEIGHTS: [f64; 5] = [1e-4, 3e-5, 1e-5, 3e-6, 1e-6];
/// Relative gain below which a still lower weight is not tried.
const LOWER_WEIGHT_GAIN: f64 = 0.02;
/// Barrier parameter that a solve with a lower weight begins with.
const LOWER_WEIGHT_BARRIER: f64 = 1e-3;
/// Mesh iterations of the refinement.
const MESHES: usize = 10;
/// λ₁ of (30) in the refinement at most: which limits give way where is found again on every mesh, which
/// takes many iterations, so that meshes grow in steps.
const PARTS: f64 = 1.0;
/// Iterations times points that a look may take once it has a bound that works: some five seconds of a planar
/// arm. What is gained after that is little, or without an end, as where rates have no limit.
const MOST_WORK: usize = 400_000;
/// Excess that the straight path is taken to have at least.
const LEAST_EXCESS: f64 = 1e-2;

/// What the search came to.
pub(super) struct Found {
    pub limits: Vec<ElasticLimit>,
    /// The trajectory of least excess; `None` where no start led to one.
    pub trajectory: Option<Discretization>,
    /// Whether its refinement converged.
    pub converged: bool,
    pub starts: StartCounts,
    pub interrupted: bool,
}

impl Found {
    /// Whether no start led to what a finer mesh confirms.
    pub fn is_no_motion(&self) -> bool {
        self.trajectory.is_none() || !self.converged
    }
}

pub(super) struct Search<'a, 'm, Sp: Space> {
    pub problem: &'a Problem,
    pub system: &'a FreeFloating<Sp>,
    pub failed: &'a Discretization,
    pub monitor: &'m mut dyn FnMut(&Event<'_>) -> Control,
    pub deadline: Deadline,
    pub statistics: Statistics,
    /// Starts so far, of all searches.
    pub tried: usize,
    /// Iterations times points of the present look.
    pub work: usize,
    /// Whether the present look has a bound that works.
    pub has_bound: bool,
}

impl<Sp: Space> Search<'_, '_, Sp> {
    /// The least excess of `limits` over all starts; `None` where there are no limits.
    ///
    /// Of the best starts, refined, the least excess whose refinement converged.
    pub fn run(&mut self, limits: Vec<ElasticLimit>) -> Result<Option<Found>, PlanError> {
        self.look(FIRST_LOOK, limits)
    }

    /// The same from few starts: where no motion keeps the limits on the joints, how much they have to give is
    /// a matter of the straight path.
    pub fn run_briefly(&mut self, limits: Vec<ElasticLimit>) -> Result<Option<Found>, PlanError> {
        let brief = Look {
            starts: 2,
            patience: 1,
            ..FIRST_LOOK
        };
        self.look(brief, limits)
    }

    /// The same from more starts and others, for the least values of what `limits` bound, be they within the
    /// limits or not, down to a part of them.
    pub fn closer(&mut self, limits: Vec<ElasticLimit>) -> Result<Option<Found>, PlanError> {
        self.look(CLOSER_LOOK, limits)
    }

    fn look(&mut self, look: Look, limits: Vec<ElasticLimit>) -> Result<Option<Found>, PlanError> {
        if limits.is_empty() {
            return Ok(None);
        }
        (self.work, self.has_bound) = (0, false);
        let groups: Vec<LimitGroup> = limits.iter().map(|limit| limit.group.clone()).collect();
        let unit = self.control_unit(look, &limits)?;
        let elastic = |part: f64| {
            Elastic::new(self.system, groups.clone(), REGULARIZATION)
                .tightened(look.tighter)
                .with_control_weight(part * unit)
        };
        let patterns = Patterns::detect(&elastic(1.0));
        let mut found = Found {
            limits,
            trajectory: None,
            converged: false,
            starts: StartCounts::default(),
            interrupted: false,
        };
        let mut candidates = Vec::new();
        for (part, cuts) in look.searched.iter().copied() {
            let searched = elastic(part);
            let feasible = self.try_starts(look, (part, cuts), &searched, &patterns, &mut found)?;
            candidates.extend(feasible);
            let held = (candidates.iter()).any(|candidate| look.ends_at(candidate.excess));
            if held || found.interrupted || self.deadline.has_passed() {
                break;
            }
        }
        candidates.sort_by(Candidate::order);
        let mut least = f64::INFINITY;
        let mut refined = 0;
        for candidate in candidates.into_iter().take(TRIED) {
            // A finer mesh asks at more points, so that the excess rises where no weight is lowered.
            if candidate.part <= WEIGHTS[WEIGHTS.len() - 1] && candidate.excess > least {
                continue;
            }
            let motion = || strip(&candidate.start.trajectory, &elastic(candidate.part));
            found.trajectory.get_or_insert_with(motion);
            let converged = self.descend(
                look, &candidate, &elastic, &patterns, &mut found, &mut least,
            )?;
            refined += usize::from(converged);
            if look.is_held(least) || refined == REFINED || self.work > self.most_work() {
                break;
            }
        }
        Ok(Some(found))
    }

    /// Refines `candidate`, then lowers the weight of the control for as long as that gains and
    /// converges; `found` and its excess `least` become what is better. Whether any converged.
    fn descend<'e>(
        &mut self,
        look: Look,
        candidate: &Candidate,
        elastic: &dyn Fn(f64) -> Elastic<'e, FreeFloating<Sp>>,
        patterns: &Patterns,
        found: &mut Found,
        least: &mut f64,
    ) -> Result<bool, PlanError> {
        let mut from = candidate.start.clone();
        let mut before = f64::INFINITY;
        for part in WEIGHTS
            .into_iter()
            .filter(|part| *part <= look.first_weight * candidate.part)
        {
            if found.interrupted || self.deadline.has_passed() {
                break;
            }
            let elastic = elastic(part);
            let outcome = self.solve(&elastic, patterns, MESHES, &from)?;
            found.interrupted = outcome.cut_short == Some(CutShort::Interrupted);
            if !outcome.converged {
                break;
            }
            self.has_bound = true;
            let excess = excess(&outcome.trajectory, &elastic);
            if excess < *least {
                *least = excess;
                found.converged = true;
                found.trajectory = Some(strip(&outcome.trajectory, &elastic));
            }
            let enough = look.is_held(excess) || excess > before * (1.0 - LOWER_WEIGHT_GAIN);
            before = excess;
            if enough {
                break;
            }
            from = Start {
                trajectory: outcome.trajectory,
                iterate: Some(outcome.iterate),
            };
        }
        Ok(before.is_finite())
    }

    /// Solves `elastic`, in which the control's weight is `part`, on the first mesh, its segments cut
    /// in so many, from one start after another.
    fn try_starts(
        &mut self,
        look: Look,
        (part, cuts): (f64, usize),
        elastic: &Elastic<'_, FreeFloating<Sp>>,
        patterns: &Patterns,
        found: &mut Found,
    ) -> Result<Vec<Candidate>, PlanError> {
        let fractions = self.system.formulation().way_point_fractions();
        let mut settings = self.settings(1);
        settings.segments *= cuts;
        let mesh = settings.first_mesh()?.through(&fractions)?;
        let starts = system::Starts::new(self.problem, self.system, look.seed);
        let mut candidates = Candidates::new(look);
        let earlier = self.tried - found.starts.tried;
        for start in 0..look.starts {
            let event = Event::Diagnosing {
                start: self.tried + start + 1,
                of: earlier + look.starts * look.searched.len(),
            };
            if (self.monitor)(&event) == Control::Stop {
                found.interrupted = true;
                break;
            }
            let from = Start {
                trajectory: extend(self.start(start, &mesh, &starts), elastic),
                iterate: None,
            };
            let outcome = self.solve(elastic, patterns, 1, &from)?;
            found.interrupted = outcome.cut_short == Some(CutShort::Interrupted);
            let excess = excess(&outcome.trajectory, elastic);
            let enough = candidates.add(part, &outcome, excess);
            if enough || found.interrupted || self.deadline.has_passed() {
                break;
            }
        }
        self.tried += candidates.starts.tried;
        found.starts.tried += candidates.starts.tried;
        found.starts.feasible += candidates.starts.feasible;
        Ok(candidates.found)
    }

    /// The problem's mesh, with so many iterations at most. Which limit gives way where changes from mesh
    /// to mesh, so that there is no structure to hold on to.
    fn settings(&self, meshes: usize) -> refine::Settings {
        refine::Settings {
            method: Method::Adaptive,
            law: Law::Paper,
            max_iterations: Some(meshes),
            lambda1: self.problem.mesh.lambda1.min(PARTS),
            ..self.problem.mesh.clone()
        }
    }

    /// Solves `elastic` from `trajectory` on so many meshes at most.
    fn solve(
        &mut self,
        elastic: &Elastic<'_, FreeFloating<Sp>>,
        patterns: &Patterns,
        meshes: usize,
        from: &Start,
    ) -> Result<Outcome, PlanError> {
        let own = &self.problem.solver;
        let solver = nlp::Settings {
            tolerance: own.tolerance.max(1e-7),
            max_iterations: own.max_iterations.min(ITERATIONS[usize::from(meshes > 1)]),
            warm_start: from.iterate.is_some().then_some(LOWER_WEIGHT_BARRIER),
            time_limit: self.deadline.remaining(),
            ..own.clone()
        };
        let refinement = Refinement {
            ocp: elastic,
            patterns,
            settings: &self.settings(meshes),
            solver: &solver,
        };
        let (mut before, mut no_motion) = (f64::INFINITY, false);
        let (mut points_now, mut work, most) = (0, self.work, self.most_work());
        let mut outcome = refinement.run(from, &mut |event| {
            let control = (self.monitor)(&Event::Refinement(event));
            match event {
                refine::Event::Mesh { points, .. } => points_now = points,
                refine::Event::Solver(_) => work += points_now,
                refine::Event::Solved(record) => {
                    no_motion = record.max_error >= GROSS && record.max_error > FALLS * before;
                    before = record.max_error;
                }
            }
            match no_motion || work > most {
                true => Control::Stop,
                false => control,
            }
        })?;
        self.work = work;
        if (no_motion || work > most) && outcome.cut_short == Some(CutShort::Interrupted) {
            outcome.cut_short = None;
        }
        self.statistics.add(&outcome.statistics);
        Ok(outcome)
    }

    /// The work after which the present look ends.
    fn most_work(&self) -> usize {
        match self.has_bound {
            true => MOST_WORK,
            false => usize::MAX,
        }
    }

    /// Weight of ∫‖u‖² at which the least control between start and goal costs as much as the straight
    /// path exceeds `limits`. A radian or metre more a joint, since the way round is longer.
    fn control_unit(&self, look: Look, limits: &[ElasticLimit]) -> Result<f64, PlanError> {
        let task = &self.problem.task;
        let duration = task.duration.center();
        let ends = task.initial_joints.iter().zip(&task.final_joints);
        let squares: f64 = ends.map(|(a, b)| ((b - a).abs() + 1.0).powi(2)).sum();
        // ∫u² of a joint that goes from rest to rest by d with least ∫u²: 12 d²/T³.
        let effort = 12.0 * squares / duration.powi(3);
        let path = JointPath::new(self.problem, &[]);
        let straight = along(
            self.system,
            duration,
            &path,
            self.problem.mesh.first_mesh()?,
        );
        let exceeded = findings(self.problem, self.system, limits, &straight);
        let size = |finding: &LimitFinding| {
            let limit = limits
                .iter()
                .find(|limit| limit.id.limit == finding.limit.along_the_path());
            limit.map_or(1.0, |limit| limit.group.scale)
        };
        let excess: f64 = exceeded
            .iter()
            .map(|found| found.excess / size(found))
            .sum();
        Ok((excess.max(LEAST_EXCESS) + look.tighter) / effort)
    }

    /// The failed trajectory first, then the straight path and others.
    fn start(&self, index: usize, mesh: &Mesh, starts: &system::Starts<'_, Sp>) -> Discretization {
        if index == 0 {
            return self.failed.resample(mesh.clone());
        }
        let (_, path) = starts.path(index - 1);
        let duration = self.problem.task.duration.center();
        along(self.system, duration, &path, mesh.clone())
    }
}

/// The sum of the amounts by which limits are exceeded, each in units of its own size.
fn excess<O: Ocp>(trajectory: &Discretization, elastic: &Elastic<'_, O>) -> f64 {
    trajectory.parameters[elastic.amounts()].iter().sum()
}
