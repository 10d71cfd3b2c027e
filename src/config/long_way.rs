//! A note on joints that are to turn by more than half a turn although nothing keeps them from
//! taking the shorter way to the same orientation.

use crate::dynamics::JointKind;
use crate::ocp::Interval;
use crate::problem::Problem;
use std::f64::consts::{PI, TAU};

/// The notes on the task of `problem`; `place` says where a key is given.
pub(super) fn notes(problem: &Problem, place: impl Fn(&str) -> String) -> Vec<String> {
    let joints = problem.robot.joints().iter().enumerate();
    let endless = |bound: &Interval| bound.lower.is_infinite() && bound.upper.is_infinite();
    let turning = joints.filter(|(j, joint)| {
        joint.kind == JointKind::Revolute && endless(&problem.limits.joint_position[*j])
    });
    turning
        .flat_map(|(j, joint)| {
            let positions = positions(problem, j);
            let legs: Vec<_> = positions
                .windows(2)
                .map(|leg| (leg[0].1, leg[1].clone()))
                .collect();
            legs.into_iter()
                .filter_map(|(from, (key, to))| {
                    let turn = to - from;
                    // Half a turn is as long either way.
                    (turn.abs() > PI + 1e-9).then(|| {
                        let shorter = turn - TAU * (turn / TAU).round();
                        format!(
                            "{}: {key}: joint '{}', which has no limits, goes {:.1}° the long way \
                         round; {:.6} is the same orientation after {:.1}°",
                            place(&key),
                            joint.name,
                            turn.to_degrees(),
                            from + shorter,
                            shorter.to_degrees() + 0.0
                        )
                    })
                })
                .collect::<Vec<_>>()
        })
        .collect()
}

/// Where joint `j` is to be, in the order of time, with the key that says so.
fn positions(problem: &Problem, j: usize) -> Vec<(String, f64)> {
    let task = &problem.task;
    let start = ("task.initial.joints".to_owned(), task.initial_joints[j]);
    let points = task.way_points.iter().enumerate();
    let passed = points
        .filter_map(|(i, point)| Some((format!("task.way_points[{i}].joints"), point.joints[j]?)));
    let goal = (!task.free_joints[j]).then(|| {
        let key = "task.final.joints".to_owned();
        (key, task.final_joints[j])
    });
    std::iter::once(start).chain(passed).chain(goal).collect()
}
