//! Way-points of the task: where the arm is to be on its way.

use super::{EndEffectorGoal, Problem, ProblemError, count, error, indexed};
use crate::ocp::Interval;

/// When a way-point is passed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Moment {
    /// Seconds after t₀; only where the duration is fixed.
    Time(f64),
    /// Fraction of the duration.
    Fraction(f64),
}

/// What has to hold at one moment between the ends.
#[derive(Debug, Clone, PartialEq)]
pub struct WayPoint {
    /// When.
    pub at: Moment,
    /// Joint positions, rad or m, of the joints that have one there; length n.
    pub joints: Vec<Option<f64>>,
    /// Joint rates, rad/s or m/s, of the joints that have one there; length n.
    pub joint_rates: Vec<Option<f64>>,
    /// Where the end effector is to be; the base frame is the one at that moment.
    pub end_effector: Option<EndEffectorGoal>,
    /// Positions of the other joints at which the search begins.
    pub guess: Option<Vec<f64>>,
}

impl WayPoint {
    /// Passes `joints` at `at`, at whatever rates.
    pub fn joints(at: Moment, joints: &[f64]) -> Self {
        Self {
            at,
            joints: joints.iter().copied().map(Some).collect(),
            joint_rates: vec![None; joints.len()],
            end_effector: None,
            guess: None,
        }
    }

    /// Meets `goal` at `at`, for a robot with `joints` joints.
    pub fn pose(at: Moment, joints: usize, goal: EndEffectorGoal) -> Self {
        Self {
            at,
            joints: vec![None; joints],
            joint_rates: vec![None; joints],
            end_effector: Some(goal),
            guess: None,
        }
    }

    /// Fraction of `duration`, whose bounds are equal where the moment is a time.
    pub fn fraction(&self, duration: &Interval) -> f64 {
        match self.at {
            Moment::Time(time) => time / duration.upper,
            Moment::Fraction(fraction) => fraction,
        }
    }
}

/// Checks the way-points of `problem`.
pub(super) fn validate(problem: &Problem) -> Result<(), ProblemError> {
    let mut before = None;
    for (i, point) in problem.task.way_points.iter().enumerate() {
        let key = format!("task.way_points[{i}]");
        moment(problem, &key, point, before)?;
        before = Some(point);
        joints(problem, &key, point)?;
        match &point.end_effector {
            Some(goal) => goal.validate(&format!("{key}.end_effector"), &problem.robot)?,
            None if [&point.joints, &point.joint_rates]
                .iter()
                .all(|values| values.iter().all(Option::is_none)) =>
            {
                let expected = "joints, joint_rates, end_effector or several of them";
                return Err(error(key, "nothing to hold there", expected));
            }
            None => {}
        }
    }
    Ok(())
}

fn moment(
    problem: &Problem,
    key: &str,
    point: &WayPoint,
    before: Option<&WayPoint>,
) -> Result<(), ProblemError> {
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

fn joints(problem: &Problem, key: &str, point: &WayPoint) -> Result<(), ProblemError> {
    let n = problem.robot.joint_count();
    let limits = &problem.limits;
    for (name, values, bounds, limit) in [
        (
            "joints",
            &point.joints,
            &limits.joint_position,
            "limits.joint_position",
        ),
        (
            "joint_rates",
            &point.joint_rates,
            &limits.joint_velocity,
            "limits.joint_velocity",
        ),
    ] {
        let key = format!("{key}.{name}");
        count(&key, values.len(), n, "joints")?;
        for (j, value) in values.iter().enumerate() {
            let Some(value) = *value else { continue };
            if !value.is_finite() {
                return Err(error(indexed(&key, j, n), value, "a finite number"));
            }
            if bounds[j].violation(value) > 0.0 {
                let found = format!("{value} for joint '{}'", problem.robot.joints()[j].name);
                let Interval { lower, upper } = bounds[j];
                let expected = format!("a value within {limit}, [{lower}, {upper}]");
                return Err(error(indexed(&key, j, n), found, expected));
            }
        }
    }
    if let Some(guess) = &point.guess {
        let key = format!("{key}.guess");
        count(&key, guess.len(), n, "joints")?;
        if let Some(j) = guess.iter().position(|value| !value.is_finite()) {
            return Err(error(indexed(&key, j, n), guess[j], "a finite number"));
        }
    }
    Ok(())
}
