//! Why a problem is infeasible: which limits cannot hold, and the smallest that can.

mod findings;

use findings::HELD;
pub(in crate::planner) use findings::findings;

use crate::dynamics::space::Space;
use crate::nlp::{self, Control, Statistics};
use crate::ocp::{Elastic, Interval, Ocp};
use crate::planner::words::cannot_hold;
use crate::planner::{Diagnosis, Event, PlanError, Starts};
use crate::problem::Problem;
use crate::refine::{self, Method, Refinement, Start};
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

/// What the diagnosis found.
pub(super) struct Diagnosed {
    /// The limits that cannot hold; `None` where all can, or where nothing was found.
    pub diagnosis: Option<Diagnosis>,
    /// Whether a trajectory within all limits was found after all.
    pub feasible: bool,
    /// Whether the monitor stopped it.
    pub interrupted: bool,
    /// The trajectory of least excess, without the excess states.
    pub trajectory: Discretization,
    pub statistics: Statistics,
}

/// Solves `problem` with elastic limits from many starts.
///
/// Limits on the base are requirements, limits on the joints are hardware: only where relaxing
/// the former does not do are the latter relaxed as well.
pub(super) fn diagnose<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    failed: &Discretization,
    monitor: &mut dyn FnMut(&Event<'_>) -> Control,
) -> Result<Diagnosed, PlanError> {
    let limits = system.elastic_limits();
    let on_base = |limit: &&ElasticLimit| limit.id.limit.is_on_base();
    let base: Vec<ElasticLimit> = limits.iter().filter(on_base).cloned().collect();
    let mut search = Search {
        problem,
        system,
        failed,
        monitor,
        statistics: Statistics::default(),
    };
    let mut found = None;
    if !base.is_empty() {
        found = search.run(base)?;
    }
    if matches!(
        found,
        None | Some(Found {
            trajectory: None,
            ..
        })
    ) {
        found = search.run(limits)?;
    }
    let statistics = search.statistics;
    let none = |interrupted| Diagnosed {
        diagnosis: None,
        feasible: false,
        interrupted,
        trajectory: failed.clone(),
        statistics,
    };
    let Some(found) = found else {
        return Ok(none(false));
    };
    let Some(trajectory) = found.trajectory else {
        return Ok(none(found.interrupted));
    };
    if found.interrupted {
        return Ok(none(true));
    }
    let limits = findings(problem, system, &found.limits, &trajectory);
    if limits.is_empty() {
        return Ok(Diagnosed {
            feasible: true,
            trajectory,
            ..none(false)
        });
    }
    let summary = cannot_hold(&limits);
    let diagnosis = Some(Diagnosis {
        limits,
        starts: found.starts,
        summary,
    });
    Ok(Diagnosed {
        diagnosis,
        trajectory,
        ..none(false)
    })
}

struct Found {
    limits: Vec<ElasticLimit>,
    /// The trajectory of least excess; `None` where no start led to one.
    trajectory: Option<Discretization>,
    starts: Starts,
    interrupted: bool,
}

struct Search<'a, 'm, Sp: Space> {
    problem: &'a Problem,
    system: &'a FreeFloating<Sp>,
    failed: &'a Discretization,
    monitor: &'m mut dyn FnMut(&Event<'_>) -> Control,
    statistics: Statistics,
}

impl<Sp: Space> Search<'_, '_, Sp> {
    /// The least excess of `limits` over all starts.
    fn run(&mut self, limits: Vec<ElasticLimit>) -> Result<Option<Found>, PlanError> {
        if limits.is_empty() {
            return Ok(None);
        }
        let groups = limits.iter().map(|limit| limit.group.clone()).collect();
        let elastic = Elastic::new(self.system, groups, REGULARIZATION);
        let patterns = Patterns::detect(&elastic);
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
            patterns: &patterns,
            settings: &settings,
            solver: &solver,
        };
        let fractions = self.system.formulation().way_point_fractions();
        let mesh = settings.first_mesh()?.through(&fractions)?;
        let mut random = fastrand::Rng::with_seed(1);
        let mut best: Option<(f64, Discretization)> = None;
        let [mut tried, mut solved, mut stale] = [0; 3];
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
            let trajectory = if start == 0 {
                self.failed.resample(mesh.clone())
            } else {
                let path = JointPath::new(self.problem, &self.detours(start, &mut random));
                along(
                    self.system,
                    self.problem.task.duration.center(),
                    &path,
                    mesh.clone(),
                )
            };
            let extended = extend(&trajectory, &elastic);
            let outcome = refinement.run(
                &Start {
                    trajectory: extended,
                    iterate: None,
                },
                &mut |event| (self.monitor)(&Event::Refinement(event)),
            )?;
            self.statistics.add(&outcome.statistics);
            tried += 1;
            if outcome.status == nlp::Status::Interrupted {
                interrupted = true;
                break;
            }
            if !outcome.status.is_solved() {
                continue;
            }
            solved += 1;
            let last = outcome.trajectory.state(outcome.trajectory.mesh.points());
            let excess: f64 = last[elastic.amounts()].iter().sum();
            let least = best.as_ref().map_or(f64::INFINITY, |(least, _)| *least);
            stale = if excess < least * (1.0 - GAIN) {
                0
            } else {
                stale + 1
            };
            if excess < least {
                best = Some((excess, strip(&outcome.trajectory, elastic.amounts().start)));
            }
            if excess < HELD || stale == PATIENCE {
                break;
            }
        }
        let trajectory = best.map(|(_, trajectory)| trajectory);
        Ok(Some(Found {
            limits,
            trajectory,
            starts: Starts {
                tried,
                feasible: solved,
            },
            interrupted,
        }))
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
