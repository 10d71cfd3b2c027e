//! Way-points: in the order of time, within the limits, with something to hold there.

use super::checks::{Checked, count, error, indexed, number, numbers};
use super::goal;
use crate::problem::builder::ProblemBuilder;
use crate::problem::error::ProblemError;
use crate::problem::limit_id::LimitId;
use crate::problem::magnitude::POSITION;
use crate::problem::way_point::{Moment, WayPoint};

pub(super) fn check(problem: &ProblemBuilder) -> Checked {
    let mut before = None;
    for (i, point) in problem.task.way_points.iter().enumerate() {
        let key = LimitId::WayPoint(i).key();
        moment(problem, &key, point, before)?;
        joints(problem, &key, point)?;
        content(problem, &key, point)?;
        before = Some(point);
    }
    Ok(())
}

fn moment(
    problem: &ProblemBuilder,
    key: &str,
    point: &WayPoint,
    before: Option<&WayPoint>,
) -> Checked {
    let duration = &problem.task.duration;
    let (key, found, range) = match point.at {
        Moment::Time(time) if !duration.is_fixed() => {
            let found = format!("{time} s, where the duration is free");
            let expected = "fraction, the fraction of the duration";
            return Err(error(format!("{key}.time"), found, expected));
        }
        Moment::Time(time) => {
            let range = format!(
                "a time above 0 and below the duration, {} s",
                duration.upper
            );
            (format!("{key}.time"), format!("{time} s"), range)
        }
        Moment::Fraction(fraction) => {
            let range = "a fraction of the duration, above 0 and below 1".to_string();
            (format!("{key}.fraction"), fraction.to_string(), range)
        }
    };
    let fraction = point.fraction(duration);
    if !(fraction > 0.0 && fraction < 1.0) {
        return Err(error(key, found, range));
    }
    match before.map(|before| before.fraction(duration)) {
        Some(last) if fraction - last < CLOSEST => {
            let expected = "way-points in the order of time, no two at one time";
            Err(error(key, found, expected))
        }
        _ => Ok(()),
    }
}

/// Fraction of the duration below which two way-points count as at one time.
const CLOSEST: f64 = 1e-6;

/// One number a joint, each sensible.
fn joints(problem: &ProblemBuilder, key: &str, point: &WayPoint) -> Checked {
    let n = problem.robot.joint_count();
    for (name, values) in [
        ("joints", &point.joints),
        ("joint_rates", &point.joint_rates),
    ] {
        let key = format!("{key}.{name}");
        count(&key, values.len(), n, "joints")?;
        for (j, value) in values.iter().enumerate() {
            let Some(value) = *value else { continue };
            number(&indexed(&key, j, n), value, POSITION)?;
        }
    }
    match &point.guess {
        Some(guess) => numbers(&format!("{key}.guess"), guess, (n, "joints"), POSITION),
        None => Ok(()),
    }
}

/// Where way-points are outside of the limits of the joints.
pub(super) fn within_limits(problem: &ProblemBuilder) -> Vec<ProblemError> {
    let limits = &problem.limits;
    let n = problem.robot.joint_count();
    let mut faults = Vec::new();
    for (i, point) in problem.task.way_points.iter().enumerate() {
        for (name, values, limit, bounds) in [
            (
                "joints",
                &point.joints,
                LimitId::JointPosition,
                &limits.joint_position,
            ),
            (
                "joint_rates",
                &point.joint_rates,
                LimitId::JointVelocity,
                &limits.joint_velocity,
            ),
        ] {
            for (j, (value, bound)) in values.iter().zip(bounds).enumerate() {
                let Some(value) = value.filter(|value| bound.violation(*value) > 0.0) else {
                    continue;
                };
                let found = format!("{value} for joint '{}'", problem.robot.joints()[j].name);
                let expected =
                    format!("a value within {limit}, [{}, {}]", bound.lower, bound.upper);
                let key = format!("{}.{name}", LimitId::WayPoint(i));
                faults.push(error(indexed(&key, j, n), found, expected));
            }
        }
    }
    faults
}

fn content(problem: &ProblemBuilder, key: &str, point: &WayPoint) -> Checked {
    let mut values = point.joints.iter().chain(&point.joint_rates);
    match &point.end_effector {
        Some(goal) => goal::check(goal, &format!("{key}.end_effector"), &problem.robot),
        None if values.all(Option::is_none) => {
            let expected = "joints, joint_rates, end_effector or several of them";
            Err(error(key, "nothing to hold there", expected))
        }
        None => Ok(()),
    }
}
