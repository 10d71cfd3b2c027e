//! Which bounds a trajectory exceeds, by how much, and in words.

use super::HELD;
use crate::dynamics::JointKind;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::ocp::{Interval, LimitGroup, Limited, Ocp};
use crate::planner::LimitFinding;
use crate::problem::Problem;
use crate::system::{FreeFloating, ROTATION, TurnLimits};
use crate::transcription::Discretization;

/// Every bound of `groups` that `trajectory` exceeds.
pub(in crate::planner) fn findings<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    groups: &[LimitGroup],
    trajectory: &Discretization,
) -> Vec<LimitFinding> {
    let formulation = system.formulation();
    let planned = crate::system::trajectory(system, trajectory);
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
pub(super) fn summary(limits: &[LimitFinding]) -> String {
    let verb = "cannot hold; the smallest bound that was found to work is";
    summary_with(limits, verb)
}

/// One sentence that says of every limit, by `verb`, what stands to the bound that would hold;
/// limits of the same bound on the same component share their part of it.
pub(in crate::planner) fn summary_with(limits: &[LimitFinding], verb: &str) -> String {
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
pub(in crate::planner) fn unit(
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
pub(in crate::planner) fn readable(unit: &str) -> (f64, String) {
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
