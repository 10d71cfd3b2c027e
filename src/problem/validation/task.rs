//! The task: duration, start and goal.

use super::checks::{Checked, count, error, indexed, interval, numbers};
use super::goal;
use crate::dynamics::attitude::Attitude;
use crate::ocp::Interval;
use crate::problem::builder::ProblemBuilder;
use crate::problem::components::base_sizes;
use crate::problem::limit_id::LimitId;
use crate::problem::magnitude;

pub(super) fn check(problem: &ProblemBuilder) -> Checked {
    duration(&problem.task.duration)?;
    joints(problem)?;
    base(problem)?;
    momentum(problem)?;
    goal(problem)
}

fn duration(duration: &Interval) -> Checked {
    const KEY: &str = "task.duration";
    if !(duration.lower > 0.0 && duration.lower.is_finite() && duration.upper.is_finite()) {
        let found = if duration.is_fixed() {
            format!("{} s", duration.lower)
        } else {
            format!("from {} to {} s", duration.lower, duration.upper)
        };
        return Err(error(KEY, found, "a finite duration above zero"));
    }
    let [least, most] = magnitude::DURATION;
    if duration.lower < least || duration.upper > most {
        let found = format!("{:e} to {:e} s", duration.lower, duration.upper);
        let expected = format!("a duration from {least:e} to {most:e} s");
        return Err(error(KEY, found, expected));
    }
    interval(KEY, duration)
}

fn joints(problem: &ProblemBuilder) -> Checked {
    let (task, n) = (&problem.task, problem.robot.joint_count());
    for (key, values) in [
        ("task.initial.joints", &task.initial_joints),
        ("task.initial.rates", &task.initial_rates),
        ("task.final.joints", &task.final_joints),
    ] {
        numbers(key, values, (n, "joints"), magnitude::POSITION)?;
    }
    count("task.final.free", task.free_joints.len(), n, "joints")
}

/// An orientation at which the description of the attitude is not singular.
fn base(problem: &ProblemBuilder) -> Checked {
    const KEY: &str = "task.initial.base_attitude";
    let (angles, _) = base_sizes(&problem.robot);
    let turned = &problem.task.initial_base_attitude;
    numbers(KEY, turned, (angles, "base angles"), magnitude::POSITION)?;
    let singular = |pitch: f64| pitch.cos().abs() < SINGULAR;
    match turned[..] {
        [_, pitch, _] if problem.attitude.is_angles() && singular(pitch) => Err(error(
            indexed(KEY, 1, 3),
            pitch,
            "a pitch off ±π/2, where roll, pitch and yaw are singular; or base.attitude = \
             \"quaternion\"",
        )),
        _ => Ok(()),
    }
}

/// Cosine of the pitch below which roll-pitch-yaw is taken as singular.
const SINGULAR: f64 = 1e-3;

fn momentum(problem: &ProblemBuilder) -> Checked {
    let momentum = &problem.task.initial_momentum;
    let (angles, lengths) = base_sizes(&problem.robot);
    let key = "task.initial.linear_momentum";
    let most = magnitude::MOMENTUM;
    numbers(key, &momentum.linear, (lengths, "base lengths"), most)?;
    let key = "task.initial.angular_momentum";
    numbers(key, &momentum.angular, (angles, "base angles"), most)
}

fn goal(problem: &ProblemBuilder) -> Checked {
    let task = &problem.task;
    match &task.end_effector {
        Some(goal) => goal::check(goal, &LimitId::EndEffector.key(), &problem.robot),
        None if task.free_joints.contains(&true) => Err(error(
            "task.final.joints",
            "some joints left free",
            "a position for every joint, or a goal for the end effector",
        )),
        None => Ok(()),
    }
}
