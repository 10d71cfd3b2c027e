//! Why a problem is infeasible: which limits cannot hold, and the smallest that can.

use super::guess::{JointPath, along};
use super::turn::{ROTATION, TurnLimits};
use super::{Diagnosis, Event, FreeFloating, LimitFinding, PlanError, Problem};
use crate::dynamics::JointKind;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::nlp::{self, Control, Statistics};
use crate::ocp::{Elastic, Interval, LimitGroup, Limited, Ocp};
use crate::refine::{self, Method, Refinement, Start};
use crate::transcription::{Discretization, Patterns};

/// Starts tried: the failed trajectory, the straight path, and paths through random detours.
const STARTS: usize = 16;
/// Starts in a row without a better result after which the search ends.
const PATIENCE: usize = 5;
/// Relative gain that counts as better.
const GAIN: f64 = 5e-3;
/// Weight of the problem's own cost, so that the least relaxation is not degenerate.
const REGULARIZATION: f64 = 1e-5;
/// Excess, relative to the limit, below which it counts as held.
const HELD: f64 = 1e-4;

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
    let groups = system.limit_groups();
    let on_base = |group: &&LimitGroup| group.name.starts_with("base");
    let base: Vec<LimitGroup> = groups.iter().filter(on_base).cloned().collect();
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
        found = search.run(groups)?;
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
    let limits = findings(problem, system, &found.groups, &trajectory);
    if limits.is_empty() {
        return Ok(Diagnosed {
            feasible: true,
            trajectory,
            ..none(false)
        });
    }
    let summary = summary(&limits);
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
    groups: Vec<LimitGroup>,
    /// The trajectory of least excess; `None` where no start led to one.
    trajectory: Option<Discretization>,
    starts: [usize; 2],
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
    /// The least excess of `groups` over all starts.
    fn run(&mut self, groups: Vec<LimitGroup>) -> Result<Option<Found>, PlanError> {
        if groups.is_empty() {
            return Ok(None);
        }
        let elastic = Elastic::new(self.system, groups.clone(), REGULARIZATION);
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
            groups,
            trajectory,
            starts: [tried, solved],
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

/// Every bound of `groups` that `trajectory` exceeds.
pub(super) fn findings<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    groups: &[LimitGroup],
    trajectory: &Discretization,
) -> Vec<LimitFinding> {
    let formulation = system.formulation();
    let planned = super::trajectory::trajectory(system, trajectory);
    let column = |rows: &[Vec<f64>], i: usize| rows.iter().map(|row| row[i]).collect::<Vec<_>>();
    let state_rows: Vec<Vec<f64>> = (0..=trajectory.mesh.points())
        .map(|k| trajectory.state(k).to_vec())
        .collect();
    let last = &state_rows[state_rows.len() - 1];
    let path_rows = system.path_rows(trajectory);
    let end_rows = system.end_rows(trajectory);
    let passed = system.passed(trajectory);
    let mut limits = Vec::new();
    for group in groups {
        if group.name == ROTATION {
            limits.extend(turn_findings(problem, system, &state_rows));
            continue;
        }
        for &member in &group.members {
            let mut at_way_point = None;
            let (key, component, bound, values) = match member {
                Limited::State(i) => {
                    let state = &formulation.states[i];
                    let key = system.state_limit(i).0;
                    (key, &state.name, state.bounds, column(&state_rows, i))
                }
                Limited::Terminal(i) => (
                    "limits.final_base_attitude",
                    &formulation.states[i].name,
                    formulation.terminal[i],
                    vec![last[i]],
                ),
                Limited::Control(j) => {
                    let control = &formulation.controls[j];
                    (
                        "limits.control",
                        &control.name,
                        control.bounds,
                        column(&planned.control, j),
                    )
                }
                Limited::Boundary(b) => {
                    let row = &formulation.boundary[b];
                    (
                        system.boundary_key(b),
                        &row.name,
                        row.bounds,
                        vec![end_rows[b]],
                    )
                }
                Limited::Passed(w, i) => {
                    at_way_point = Some(w);
                    let bound = formulation.way_points[w].states[i];
                    ("task.way_points", &group.name, bound, vec![passed[w].0[i]])
                }
                Limited::WayPoint(w, r) => {
                    at_way_point = Some(w);
                    let bound = formulation.way_points[w].rows[r].bounds;
                    ("task.way_points", &group.name, bound, vec![passed[w].1[r]])
                }
                Limited::Path(p) => {
                    let row = &formulation.path[p];
                    (
                        system.path_limit(p).0,
                        &row.name,
                        row.bounds,
                        column(&path_rows, p),
                    )
                }
            };
            let reached = values.iter().fold(
                Interval::new(f64::INFINITY, f64::NEG_INFINITY),
                |range, &v| Interval::new(range.lower.min(v), range.upper.max(v)),
            );
            let excess = values
                .iter()
                .map(|&v| bound.violation(v))
                .fold(0.0, f64::max);
            if excess > HELD * group.scale {
                limits.push(LimitFinding {
                    key: match at_way_point {
                        Some(w) => format!("{key}[{w}]"),
                        None => key.into(),
                    },
                    component: component.clone(),
                    unit: unit(problem, key, component, member_joint(system, member)),
                    bound,
                    excess,
                    smallest_bound: widened(bound, reached),
                });
            }
        }
    }
    limits
}

/// The bounds on the rotation angle that `states`, one row a node, exceed.
fn turn_findings<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    states: &[Vec<f64>],
) -> Vec<LimitFinding> {
    let attitude = system.attitude();
    let turned: Vec<f64> = states
        .iter()
        .map(|x| attitude.squared_turn(&x[..attitude.count()]).sqrt())
        .collect();
    let largest = turned.iter().copied().fold(0.0, f64::max);
    let last = turned[turned.len() - 1];
    let [along, at_end] = TurnLimits::bounds(problem);
    [
        ("limits.base_attitude", along, largest),
        ("limits.final_base_attitude", at_end, last),
    ]
    .into_iter()
    .filter(|(_, bound, reached)| reached - bound > HELD * bound.max(1e-3))
    .map(|(key, bound, reached)| LimitFinding {
        key: key.into(),
        component: ROTATION.into(),
        unit: "rad",
        bound: Interval::new(0.0, bound),
        excess: reached - bound,
        smallest_bound: Interval::new(0.0, reached),
    })
    .collect()
}

/// `bound` widened to hold `reached`; symmetric bounds stay symmetric.
fn widened(bound: Interval, reached: Interval) -> Interval {
    let wide = Interval::new(
        bound.lower.min(reached.lower),
        bound.upper.max(reached.upper),
    );
    if bound.lower == -bound.upper {
        Interval::symmetric(wide.upper.max(-wide.lower))
    } else {
        wide
    }
}

/// One sentence about what cannot hold.
fn summary(limits: &[LimitFinding]) -> String {
    let verb = "cannot hold; the smallest bound that was found to work is";
    summary_with(limits, verb)
}

/// One sentence that says of every limit, by `verb`, what stands to the bound that would hold;
/// limits of the same bound on the same component share their part of it.
pub(super) fn summary_with(limits: &[LimitFinding], verb: &str) -> String {
    let mut parts: Vec<(Vec<String>, &LimitFinding)> = Vec::new();
    for finding in limits {
        let limit = format!("{} = {}", finding.key, shown(finding, &finding.bound));
        let same = |other: &LimitFinding| {
            other.component == finding.component
                && other.bound == finding.bound
                && shown(other, &other.smallest_bound) == shown(finding, &finding.smallest_bound)
        };
        match parts.iter_mut().find(|(_, other)| same(other)) {
            Some((keys, _)) => keys.push(limit),
            None => parts.push((vec![limit], finding)),
        }
    }
    let part = |(keys, finding): &(Vec<String>, &LimitFinding)| {
        format!(
            "{} ({}) {verb} {}",
            keys.join(" and "),
            finding.component,
            shown(finding, &finding.smallest_bound)
        )
    };
    parts.iter().map(part).collect::<Vec<_>>().join("; ")
}

/// The joint a bound is about; `None` for the base and for what is about no single joint.
fn member_joint<Sp: Space>(system: &FreeFloating<Sp>, member: Limited) -> Option<usize> {
    match member {
        Limited::State(i) | Limited::Terminal(i) | Limited::Passed(_, i) => system.state_limit(i).1,
        Limited::Control(j) => Some(j),
        Limited::Path(p) => system.path_limit(p).1,
        Limited::Boundary(_) | Limited::WayPoint(..) => None,
    }
}

/// Unit of a bound: of a quantity of the problem file's key `key`, and of a joint where it is one's.
pub(super) fn unit(
    problem: &Problem,
    key: &str,
    component: &str,
    joint: Option<usize>,
) -> &'static str {
    if joint.is_none() && key.starts_with("task.") {
        // Turns are bounded by their sines.
        return if component.contains("turn") { "1" } else { "m" };
    }
    let slides = joint.is_some_and(|j| problem.robot.joints()[j].kind == JointKind::Prismatic);
    match (key, slides) {
        ("task.way_points", false) if component.contains("rate") => "rad/s",
        ("task.way_points", true) if component.contains("rate") => "m/s",
        ("limits.keep_out", _) => "of the least distance squared",
        ("limits.torque", false) => "N·m",
        ("limits.torque", true) => "N",
        ("limits.base_rate" | "limits.joint_velocity", false) => "rad/s",
        ("limits.joint_velocity", true) => "m/s",
        ("limits.control", false) => "rad/s²",
        ("limits.control", true) => "m/s²",
        (_, true) => "m",
        (_, false) => "rad",
    }
}

/// Factor and unit by which a person reads a quantity: angles in degrees.
pub(super) fn readable(unit: &str) -> (f64, String) {
    match unit.strip_prefix("rad") {
        Some(rest) => (1f64.to_degrees(), format!("°{rest}")),
        None => (1.0, format!(" {unit}")),
    }
}

/// A bound as a person reads it.
fn shown(finding: &LimitFinding, bound: &Interval) -> String {
    let (factor, unit) = readable(finding.unit);
    if finding.component == ROTATION {
        format!("{:.2}{unit}", bound.upper * factor)
    } else if bound.lower == -bound.upper {
        format!("±{:.2}{unit}", bound.upper * factor)
    } else {
        format!(
            "[{:.2}, {:.2}]{unit}",
            bound.lower * factor,
            bound.upper * factor
        )
    }
}
