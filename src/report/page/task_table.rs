//! The problem in a table: where the arm starts and goes, limits and weights.

use super::charts::short;
use super::texts::Fact;
use crate::dynamics::JointKind;
use crate::dynamics::attitude::SpatialAttitude;
use crate::ocp::Interval;
use crate::problem::{
    ComponentKind, CostId, EndEffectorGoal, GoalFrame, Limits, Moment, Problem, Unit, WayPoint,
};
use crate::report::format::{list, rotation};

/// What is asked of one joint, a text a column of [`joint_columns`].
pub(super) struct JointRow {
    pub name: String,
    pub cells: Vec<String>,
}

/// Headings behind the name of a joint.
pub(super) const JOINT_COLUMNS: [&str; 6] = [
    "start",
    "goal",
    "position limit",
    "rate limit",
    "limit of u",
    "torque or force limit",
];

/// One row a joint.
pub(super) fn joints(problem: &Problem) -> Vec<JointRow> {
    let (task, limits) = (&problem.task, &problem.limits);
    let joints = problem.robot.joints().iter().enumerate();
    joints
        .map(|(j, joint)| {
            let position = Unit::position(joint.kind);
            let goal = match task.free_joints[j] {
                true => "free".into(),
                false => value(task.final_joints[j], position),
            };
            let mut cells = vec![value(task.initial_joints[j], position), goal];
            let of = |limits: &[Interval], unit: fn(JointKind) -> Unit| {
                limits
                    .get(j)
                    .map_or_else(none, |limit| range(*limit, unit(joint.kind)))
            };
            cells.extend([
                of(&limits.joint_position, Unit::position),
                of(&limits.joint_velocity, Unit::rate),
                of(&limits.control, Unit::acceleration),
                of(&limits.torque, Unit::effort),
            ]);
            JointRow {
                name: joint.name.clone(),
                cells,
            }
        })
        .collect()
}

/// All that is not asked of single joints.
pub(super) fn rest(problem: &Problem) -> Vec<Fact> {
    let task = &problem.task;
    let duration = match task.duration {
        Interval { lower, .. } if task.duration.is_fixed() => format!("{} s", short(lower)),
        Interval { lower, upper } => {
            format!("free, {} s to {} s", short(lower), short(upper))
        }
    };
    let mut facts = vec![Fact::new("duration", duration, "")];
    if task.initial_rates.iter().any(|rate| *rate != 0.0) {
        let joints = problem.robot.joints().iter().zip(&task.initial_rates);
        let rates: Vec<String> = joints
            .map(|(joint, rate)| format!("{} {}", joint.name, value(*rate, Unit::rate(joint.kind))))
            .collect();
        facts.push(Fact::new("joint rates at the start", rates.join(", "), ""));
    }
    if task.starts_turned() {
        let angles = list(&task.initial_base_attitude, angle);
        facts.push(Fact::new("base attitude at the start", angles, ""));
    }
    if !task.initial_momentum.is_zero() {
        let [linear, angular] = [
            &task.initial_momentum.linear,
            &task.initial_momentum.angular,
        ]
        .map(|values| list(values, short));
        let momentum = format!("{linear} kg m/s, {angular} kg m²/s about the mass centre");
        facts.push(Fact::new("momentum", momentum, ""));
    }
    for (w, point) in task.way_points.iter().enumerate() {
        let what = format!("way-point {}", w + 1);
        facts.push(Fact::new(&what, way_point(problem, point), ""));
    }
    if let Some(goal) = &task.end_effector {
        facts.push(Fact::new("end effector at the end", pose(goal), ""));
    }
    facts.extend(base_limits(problem, &problem.limits));
    let names: Vec<&str> = problem
        .limits
        .keep_out
        .iter()
        .map(|pair| pair.name.as_str())
        .collect();
    let apart = match names[..] {
        [] => "nothing: collisions are not checked".into(),
        _ => format!("{}; other collisions are not checked", names.join(", ")),
    };
    facts.push(Fact::new("kept apart", apart, ""));
    facts.push(Fact::new(
        "cost J",
        weights(problem),
        "weights as in the problem file, of quantities in rad, m, s, N and N·m",
    ));
    facts
}

/// Limits on the base.
fn base_limits(problem: &Problem, limits: &Limits) -> Vec<Fact> {
    let on_base = limits
        .entries()
        .filter(|entry| entry.components != ComponentKind::Joint);
    let bounded = on_base.filter(|entry| entry.bounds.iter().any(|limit| !limit.is_free()));
    bounded
        .map(|entry| {
            let ranges: Vec<String> = entry
                .bounds
                .iter()
                .enumerate()
                .map(|(i, limit)| range(*limit, entry.unit(&problem.robot, i)))
                .collect();
            let alike = ranges.iter().all(|range| *range == ranges[0]);
            let shown = match ranges.len() {
                _ if alike => ranges[0].clone(),
                _ => ranges.join(", "),
            };
            Fact::new(&format!("limit, {}", entry.id.words()), shown, "")
        })
        .collect()
}

fn weights(problem: &Problem) -> String {
    let cost = &problem.cost;
    let rotation = problem.has_rotation_angle();
    let mut terms = Vec::new();
    for entry in cost
        .entries()
        .filter(|entry| entry.weights.iter().any(|w| *w != 0.0))
    {
        let alike = entry.weights.iter().all(|w| *w == entry.weights[0]);
        let weight = match alike {
            true => short(entry.weights[0]),
            false => list(entry.weights, short),
        };
        terms.push(format!("{weight} {}", entry.id.formula(rotation)));
    }
    if cost.duration != 0.0 {
        terms.push(format!("{} t_f", short(cost.duration)));
    }
    if cost.rate_matrix.is_some() {
        terms.push(CostId::RateMatrix.formula(rotation).into());
    }
    match terms[..] {
        [] => "none".into(),
        _ => terms.join(" + "),
    }
}

fn way_point(problem: &Problem, point: &WayPoint) -> String {
    let at = match point.at {
        Moment::Time(time) => format!("at {} s", short(time)),
        Moment::Fraction(part) => format!("at {} % of the duration", short(100.0 * part)),
    };
    let joints = problem.robot.joints().iter().zip(&point.joints);
    let joints = joints.filter_map(|(joint, position)| {
        Some(format!(
            "{} {}",
            joint.name,
            value((*position)?, Unit::position(joint.kind))
        ))
    });
    let rates = problem.robot.joints().iter().zip(&point.joint_rates);
    let rates = rates.filter_map(|(joint, rate)| {
        Some(format!(
            "{} {}",
            joint.name,
            value((*rate)?, Unit::rate(joint.kind))
        ))
    });
    let goal = point
        .end_effector
        .as_ref()
        .map(|goal| format!("end effector {}", pose(goal)));
    let asked: Vec<String> = joints.chain(rates).chain(goal).collect();
    format!("{at}: {}", asked.join(", "))
}

/// Where the end effector is to be.
fn pose(goal: &EndEffectorGoal) -> String {
    let allowed = |value: f64, unit: Unit| match value {
        0.0 => String::new(),
        _ => format!(" ± {}", self::value(value, unit)),
    };
    let frame = match goal.frame {
        GoalFrame::Inertial => "in inertial axes from the mass centre",
        GoalFrame::Start => "in the base frame of the start",
        GoalFrame::Base => "in the base frame",
    };
    let position = goal.position.as_deref().map(|position| {
        let room = allowed(goal.position_tolerance, Unit::Metre);
        format!(
            "at {}{room}",
            list(position, |length| value(length, Unit::Metre))
        )
    });
    let orientation = goal.orientation.as_deref().map(|angles| {
        let room = allowed(goal.orientation_tolerance, Unit::Radian);
        let turned = match angles.len() {
            1 => angle(angles[0]),
            _ => rotation(SpatialAttitude::RollPitchYaw, angles),
        };
        format!("turned by {turned}{room}")
    });
    let parts: Vec<String> = position.into_iter().chain(orientation).collect();
    format!("{} {frame}", parts.join(", "))
}

fn angle(value: f64) -> String {
    self::value(value, Unit::Radian)
}

/// A value as a person reads it.
fn value(value: f64, unit: Unit) -> String {
    let (factor, unit) = match unit {
        Unit::Metre => (100.0, " cm"),
        Unit::MetrePerSecond => (100.0, " cm/s"),
        unit => unit.readable(),
    };
    format!("{}{unit}", short(factor * value))
}

fn none() -> String {
    "–".into()
}

fn range(limit: Interval, unit: Unit) -> String {
    let Interval { lower, upper } = limit;
    match (lower.is_finite(), upper.is_finite()) {
        (false, false) => none(),
        (true, false) => format!("from {}", value(lower, unit)),
        (false, true) => format!("up to {}", value(upper, unit)),
        _ if lower == -upper => format!("±{}", value(upper, unit)),
        _ => format!("{} to {}", value(lower, unit), value(upper, unit)),
    }
}
