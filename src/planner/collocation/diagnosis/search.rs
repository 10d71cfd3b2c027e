//! The least excess of elastic limits: searched from many starts on one mesh, then refined.
//!
//! On one mesh a programme may find an excess that no motion has, by moving between the points where
//! nothing is asked. So a result counts as found only where its refinement converged, and the control
//! has a weight: small where the motion stays smooth, else larger.

use super::findings::{HELD, findings};
use crate::collocation::Mesh;
use crate::dynamics::space::Space;
use crate::nlp::{self, Control, Deadline, Statistics};
use crate::ocp::{Elastic, Interval, LimitGroup, Ocp};
use crate::planner::{Event, LimitFinding, PlanError, Starts};
use crate::problem::Problem;
use crate::refine::{self, CutShort, Method, Outcome, Refinement, Start};
use crate::system::{ElasticLimit, FreeFloating, JointPath, along};
use crate::transcription::{Discretization, Patterns};

/// Starts tried: the failed trajectory, the straight path, and paths through random detours.
const STARTS: usize = 16;
/// Starts in a row without a better result after which the search ends.
const PATIENCE: usize = 5;
/// How many of the best starts of a search are refined.
const REFINED: usize = 2;
/// Iterations of one solve of a search, and of one in the refinement; fewer where the solver's limit
/// is lower.
pub(super) const ITERATIONS: [u32; 2] = [300, 150];
/// Relative gain that counts as better.
const GAIN: f64 = 5e-3;
/// Relative difference below which two starts ended at the same excess.
const SAME: f64 = 1e-6;
/// Largest error (28) beyond which the solution on one mesh says nothing of a motion.
const GROSS: f64 = 1.0;
/// Starts with such an error, before any other, after which a search is given up.
const GROSS_STARTS: usize = 3;
/// Weight of the problem's own cost, so that the least relaxation is not degenerate.
const REGULARIZATION: f64 = 1e-5;
/// Weights of the control in the searches, each as the part of the excess along the straight path
/// that the least control from start to goal costs. The second search is made where the solutions of
/// the first are no motions.
const SEARCHED: [f64; 2] = [1e-6, 1e-3];
/// The same in the refinement, the next where one does not converge.
const REFINED_CONTROL: [f64; 3] = [1e-6, 1e-4, 1e-3];
/// Mesh iterations of the refinement.
const MESHES: usize = 10;
/// Excess that the straight path is taken to have at least.
const LEAST_EXCESS: f64 = 1e-2;

/// What the search came to.
pub(super) struct Found {
    pub limits: Vec<ElasticLimit>,
    /// The trajectory of least excess; `None` where no start led to one.
    pub trajectory: Option<Discretization>,
    /// Whether its refinement converged.
    pub converged: bool,
    pub starts: Starts,
    pub interrupted: bool,
}

pub(super) struct Search<'a, 'm, Sp: Space> {
    pub problem: &'a Problem,
    pub system: &'a FreeFloating<Sp>,
    pub failed: &'a Discretization,
    pub monitor: &'m mut dyn FnMut(&Event<'_>) -> Control,
    pub deadline: Deadline,
    pub statistics: Statistics,
}

/// Where one start ended.
struct Candidate {
    /// The sum of the amounts by which limits are exceeded.
    excess: f64,
    /// The largest error (28).
    error: f64,
    /// The trajectory with the states of excess.
    trajectory: Discretization,
}

impl Candidate {
    fn is_gross(&self) -> bool {
        self.error.is_nan() || self.error >= GROSS
    }
}

/// What the starts came to so far.
#[derive(Default)]
struct Candidates {
    /// Every start that was solved, the least excess first.
    found: Vec<Candidate>,
    starts: Starts,
    /// Starts since the last gain.
    stale: usize,
}

impl Candidates {
    /// Adds what a start ended at, where it was solved; whether the search may end.
    fn add<O: Ocp>(&mut self, outcome: &Outcome, elastic: &Elastic<'_, O>) -> bool {
        self.starts.tried += 1;
        if !outcome.status.is_solved() {
            return false;
        }
        self.starts.feasible += 1;
        let excess = excess(&outcome.trajectory, elastic);
        let least = self
            .found
            .first()
            .map_or(f64::INFINITY, |least| least.excess);
        self.stale = match excess < least * (1.0 - GAIN) {
            true => 0,
            false => self.stale + 1,
        };
        let same = |other: &Candidate| (other.excess - excess).abs() <= SAME * excess;
        if self.found.iter().any(same) {
            return excess < HELD || self.stale == PATIENCE;
        }
        let place = self.found.partition_point(|other| other.excess <= excess);
        let error = outcome.max_error();
        let candidate = Candidate {
            excess,
            error,
            trajectory: outcome.trajectory.clone(),
        };
        self.found.insert(place, candidate);
        let gross = self.found.iter().all(Candidate::is_gross);
        if gross && self.found.len() >= GROSS_STARTS {
            return true;
        }
        excess < HELD || self.stale == PATIENCE
    }
}

impl<Sp: Space> Search<'_, '_, Sp> {
    /// The least excess of `limits` over all starts; `None` where there are no limits.
    ///
    /// Of the best starts, refined, the least excess whose refinement converged.
    pub fn run(&mut self, limits: Vec<ElasticLimit>) -> Result<Option<Found>, PlanError> {
        if limits.is_empty() {
            return Ok(None);
        }
        let groups: Vec<LimitGroup> = limits.iter().map(|limit| limit.group.clone()).collect();
        let unit = self.control_unit(&limits)?;
        let elastic = |part: f64| {
            Elastic::new(self.system, groups.clone(), REGULARIZATION)
                .with_control_weight(part * unit)
        };
        let patterns = Patterns::detect(&elastic(1.0));
        let mut found = Found {
            limits,
            trajectory: None,
            converged: false,
            starts: Starts::default(),
            interrupted: false,
        };
        let mut least = f64::INFINITY;
        for part in SEARCHED {
            let candidates = self.try_starts(&elastic(part), &patterns, &mut found)?;
            let rough = candidates.first().is_none_or(Candidate::is_gross);
            for candidate in candidates.into_iter().take(REFINED) {
                let states = self.system.formulation().states.len();
                let motion = || strip(&candidate.trajectory, states);
                found.trajectory.get_or_insert_with(motion);
                let parts = &REFINED_CONTROL[usize::from(candidate.is_gross())..];
                for part in parts {
                    if found.interrupted || self.deadline.has_passed() {
                        return Ok(Some(found));
                    }
                    let elastic = elastic(*part);
                    let outcome = self.solve(&elastic, &patterns, MESHES, &candidate.trajectory)?;
                    found.interrupted = outcome.cut_short == Some(CutShort::Interrupted);
                    if !outcome.converged {
                        continue;
                    }
                    let excess = excess(&outcome.trajectory, &elastic);
                    if excess < least {
                        least = excess;
                        found.converged = true;
                        found.trajectory = Some(strip(&outcome.trajectory, states));
                    }
                    break;
                }
            }
            if !rough || least < HELD {
                break;
            }
        }
        Ok(Some(found))
    }

    /// Solves `elastic` on the first mesh from one start after another.
    fn try_starts(
        &mut self,
        elastic: &Elastic<'_, FreeFloating<Sp>>,
        patterns: &Patterns,
        found: &mut Found,
    ) -> Result<Vec<Candidate>, PlanError> {
        let fractions = self.system.formulation().way_point_fractions();
        let mesh = self.settings(1).first_mesh()?.through(&fractions)?;
        let mut random = fastrand::Rng::with_seed(1);
        let mut candidates = Candidates::default();
        for start in 0..STARTS {
            let event = Event::Diagnosing {
                start: start + 1,
                of: STARTS,
            };
            if (self.monitor)(&event) == Control::Stop {
                found.interrupted = true;
                break;
            }
            let from = extend(&self.start(start, &mesh, &mut random), elastic);
            let outcome = self.solve(elastic, patterns, 1, &from)?;
            found.interrupted = outcome.cut_short == Some(CutShort::Interrupted);
            let enough = candidates.add(&outcome, elastic);
            if enough || found.interrupted || self.deadline.has_passed() {
                break;
            }
        }
        found.starts.tried += candidates.starts.tried;
        found.starts.feasible += candidates.starts.feasible;
        Ok(candidates.found)
    }

    /// The problem's mesh, with so many iterations at most.
    fn settings(&self, meshes: usize) -> refine::Settings {
        refine::Settings {
            method: Method::Adaptive,
            max_iterations: Some(meshes),
            ..self.problem.mesh.clone()
        }
    }

    /// Solves `elastic` from `trajectory` on so many meshes at most.
    fn solve(
        &mut self,
        elastic: &Elastic<'_, FreeFloating<Sp>>,
        patterns: &Patterns,
        meshes: usize,
        trajectory: &Discretization,
    ) -> Result<Outcome, PlanError> {
        let own = &self.problem.solver;
        let solver = nlp::Settings {
            tolerance: own.tolerance.max(1e-7),
            max_iterations: own.max_iterations.min(ITERATIONS[usize::from(meshes > 1)]),
            warm_start: None,
            time_limit: self.deadline.remaining(),
            ..own.clone()
        };
        let refinement = Refinement {
            ocp: elastic,
            patterns,
            settings: &self.settings(meshes),
            solver: &solver,
        };
        let from = Start {
            trajectory: trajectory.clone(),
            iterate: None,
        };
        let outcome = refinement.run(&from, &mut |event| {
            (self.monitor)(&Event::Refinement(event))
        })?;
        self.statistics.add(&outcome.statistics);
        Ok(outcome)
    }

    /// Weight of ∫‖u‖² at which the least control between start and goal costs as much as the straight
    /// path exceeds `limits`. A radian or metre more a joint, since the way round is longer.
    fn control_unit(&self, limits: &[ElasticLimit]) -> Result<f64, PlanError> {
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
        Ok(excess.max(LEAST_EXCESS) / effort)
    }

    /// The failed trajectory first, then paths through more and more detours.
    fn start(&self, index: usize, mesh: &Mesh, random: &mut fastrand::Rng) -> Discretization {
        if index == 0 {
            return self.failed.resample(mesh.clone());
        }
        let path = JointPath::new(self.problem, &self.detours(index, random));
        let duration = self.problem.task.duration.center();
        along(self.system, duration, &path, mesh.clone())
    }

    /// None for the first path, then one to four points within the joints' limits.
    fn detours(&self, start: usize, random: &mut fastrand::Rng) -> Vec<Vec<f64>> {
        let count = (start - 1) % 5;
        let task = &self.problem.task;
        (0..count)
            .map(|_| {
                let within = |(j, bounds): (usize, &Interval)| {
                    // Without limits: a radian or metre around start and goal.
                    let ends = [task.initial_joints[j], task.final_joints[j]];
                    let around =
                        Interval::new(ends[0].min(ends[1]) - 1.0, ends[0].max(ends[1]) + 1.0);
                    let lower = if bounds.lower.is_finite() {
                        bounds.lower
                    } else {
                        around.lower
                    };
                    let upper = if bounds.upper.is_finite() {
                        bounds.upper
                    } else {
                        around.upper
                    };
                    lower + random.f64() * (upper - lower)
                };
                self.problem
                    .limits
                    .joint_position
                    .iter()
                    .enumerate()
                    .map(within)
                    .collect()
            })
            .collect()
    }
}

/// The sum of the amounts by which limits are exceeded, each in units of its own size.
fn excess<O: Ocp>(trajectory: &Discretization, elastic: &Elastic<'_, O>) -> f64 {
    let last = trajectory.state(trajectory.mesh.points());
    last[elastic.amounts()].iter().sum()
}

/// The trajectory with excess states of one unit.
fn extend<O: Ocp>(trajectory: &Discretization, elastic: &Elastic<'_, O>) -> Discretization {
    let count = elastic.amounts().len();
    let x = trajectory
        .x
        .chunks_exact(trajectory.states)
        .flat_map(|row| row.iter().copied().chain(std::iter::repeat_n(1.0, count)))
        .collect();
    Discretization {
        x,
        states: trajectory.states + count,
        ..trajectory.clone()
    }
}

/// The trajectory's first `states` states.
fn strip(trajectory: &Discretization, states: usize) -> Discretization {
    let rows = trajectory.x.chunks_exact(trajectory.states);
    let x = rows.flat_map(|row| row[..states].iter().copied()).collect();
    Discretization {
        x,
        states,
        ..trajectory.clone()
    }
}
