//! The least excess of elastic limits, searched from many starts.

use super::findings::HELD;
use crate::collocation::Mesh;
use crate::dynamics::space::Space;
use crate::nlp::{self, Control, Statistics};
use crate::ocp::{Elastic, Interval, Ocp};
use crate::planner::{Event, PlanError, Starts};
use crate::problem::Problem;
use crate::refine::{self, Method, Outcome, Refinement, Start};
use crate::system::{ElasticLimit, FreeFloating, JointPath, along};
use crate::transcription::{Discretization, Patterns};

/// Starts tried: the failed trajectory, the straight path, and paths through random detours.
const STARTS: usize = 16;
/// Starts in a row without a better result after which the search ends.
const PATIENCE: usize = 5;
/// Relative gain that counts as better.
const GAIN: f64 = 5e-3;
/// Weight of the problem's own cost, so that the least relaxation is not degenerate.
const REGULARIZATION: f64 = 1e-5;

/// What the search came to.
pub(super) struct Found {
    pub limits: Vec<ElasticLimit>,
    /// The trajectory of least excess; `None` where no start led to one.
    pub trajectory: Option<Discretization>,
    pub starts: Starts,
    pub interrupted: bool,
}

pub(super) struct Search<'a, 'm, Sp: Space> {
    pub problem: &'a Problem,
    pub system: &'a FreeFloating<Sp>,
    pub failed: &'a Discretization,
    pub monitor: &'m mut dyn FnMut(&Event<'_>) -> Control,
    pub statistics: Statistics,
}

/// The best of the starts so far.
#[derive(Default)]
struct Best {
    /// The least excess and its trajectory, without the excess states.
    least: Option<(f64, Discretization)>,
    starts: Starts,
    /// Starts since the last gain.
    stale: usize,
}

impl Best {
    /// Adds what a start ended at, where it was solved; whether the search may end.
    fn add<O: Ocp>(&mut self, outcome: &Outcome, elastic: &Elastic<'_, O>) -> bool {
        self.starts.tried += 1;
        if !outcome.status.is_solved() {
            return false;
        }
        self.starts.feasible += 1;
        let last = outcome.trajectory.state(outcome.trajectory.mesh.points());
        let excess: f64 = last[elastic.amounts()].iter().sum();
        let least = self
            .least
            .as_ref()
            .map_or(f64::INFINITY, |(least, _)| *least);
        self.stale = match excess < least * (1.0 - GAIN) {
            true => 0,
            false => self.stale + 1,
        };
        if excess < least {
            let states = elastic.amounts().start;
            self.least = Some((excess, strip(&outcome.trajectory, states)));
        }
        excess < HELD || self.stale == PATIENCE
    }
}

impl<Sp: Space> Search<'_, '_, Sp> {
    /// The least excess of `limits` over all starts; `None` where there are no limits.
    pub fn run(&mut self, limits: Vec<ElasticLimit>) -> Result<Option<Found>, PlanError> {
        if limits.is_empty() {
            return Ok(None);
        }
        let groups = limits.iter().map(|limit| limit.group.clone()).collect();
        let elastic = Elastic::new(self.system, groups, REGULARIZATION);
        let settings = refine::Settings {
            method: Method::Adaptive,
            max_iterations: 1,
            ..self.problem.mesh.clone()
        };
        let solver = nlp::Settings {
            tolerance: 1e-7,
            max_iterations: 300,
            warm_start: None,
            ..self.problem.solver.clone()
        };
        let refinement = Refinement {
            ocp: &elastic,
            patterns: &Patterns::detect(&elastic),
            settings: &settings,
            solver: &solver,
        };
        let fractions = self.system.formulation().way_point_fractions();
        let mesh = settings.first_mesh()?.through(&fractions)?;
        let mut random = fastrand::Rng::with_seed(1);
        let mut best = Best::default();
        let mut interrupted = false;
        for start in 0..STARTS {
            let event = Event::Diagnosing {
                start: start + 1,
                of: STARTS,
            };
            if (self.monitor)(&event) == Control::Stop {
                interrupted = true;
                break;
            }
            let from = Start {
                trajectory: extend(&self.start(start, &mesh, &mut random), &elastic),
                iterate: None,
            };
            let outcome = refinement.run(&from, &mut |event| {
                (self.monitor)(&Event::Refinement(event))
            })?;
            self.statistics.add(&outcome.statistics);
            interrupted = outcome.status == nlp::Status::Interrupted;
            if best.add(&outcome, &elastic) || interrupted {
                break;
            }
        }
        Ok(Some(Found {
            limits,
            trajectory: best.least.map(|(_, trajectory)| trajectory),
            starts: best.starts,
            interrupted,
        }))
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
