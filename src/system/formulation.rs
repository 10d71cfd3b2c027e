//! Names and bounds of states, controls and path rows.

use super::rows::TurnLimits;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::ocp::{Formulation, Interval, Quantity};
use crate::problem::Problem;

/// The formulation of `problem` without its goals for the end effector and its way-points.
pub(super) fn formulation<Sp: Space>(
    problem: &Problem,
    (attitude, turn): (Sp::Attitude, &TurnLimits),
    rate_rows: bool,
    torque_rows: bool,
) -> Formulation {
    let n = problem.robot.joint_count();
    let (task, limits) = (&problem.task, &problem.limits);
    let joints = |what: &str, bounds: &[Interval]| -> Vec<Quantity> {
        let named =
            |(j, b): (usize, &Interval)| Quantity::new(format!("joint {} {what}", j + 1), *b);
        bounds.iter().enumerate().map(named).collect()
    };
    let angles = |suffix: &str, bounds: &[Interval]| -> Vec<Quantity> {
        let named = |(name, b): (&&str, &Interval)| Quantity::new(format!("{name}{suffix}"), *b);
        attitude.names().iter().zip(bounds).map(named).collect()
    };
    let fixed = |values: &[f64]| {
        values
            .iter()
            .copied()
            .map(Interval::fixed)
            .collect::<Vec<_>>()
    };
    let axes = ["x", "y", "z"].iter().zip(&limits.base_rate);
    let spin = axes.map(|(axis, b)| Quantity::new(format!("base angular velocity {axis}"), *b));
    let mut path = Vec::new();
    if rate_rows && attitude.is_angles() {
        path.extend(angles(" rate", &limits.base_rate));
    } else if rate_rows {
        path.extend(spin);
    }
    if torque_rows {
        path.extend(joints("torque", &limits.torque));
    }
    let rest = vec![0.0; n];
    let [along, last] = turn.parameter_bounds(problem, attitude.start());
    Formulation {
        states: [
            angles("", &along),
            joints("position", &limits.joint_position),
            joints("rate", &limits.joint_velocity),
        ]
        .concat(),
        controls: joints("control", &limits.control),
        path,
        boundary: Vec::new(),
        initial: [
            fixed(attitude.start()),
            fixed(&task.initial_joints),
            fixed(&task.initial_rates),
        ]
        .concat(),
        terminal: [
            last,
            fixed(&task.final_joints)
                .into_iter()
                .zip(&task.free_joints)
                .map(|(at, &free)| if free { Interval::FREE } else { at })
                .collect(),
            fixed(&rest),
        ]
        .concat(),
        duration: task.duration,
        way_points: Vec::new(),
    }
}
