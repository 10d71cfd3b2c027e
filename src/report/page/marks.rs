//! Goals and way-points in the picture.

use super::pose::{base_pose, from_picture};
use crate::dynamics::attitude::SpatialAttitude;
use crate::problem::{EndEffectorGoal, GoalFrame, Problem};
use crate::system::at_fractions;
use crate::transcription::Discretization;
use crate::verify::bodies::{BaseMotion, orientation};
use nalgebra::Vector3;
use serde::Serialize;

/// A goal or a way-point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Mark {
    label: String,
    /// Fraction of the duration at which it is to be met.
    part: f64,
    /// Where the end effector is to be, m; `None` where its position is left open.
    at: Option<[f64; 3]>,
    /// How far from there it may be along each axis, m.
    within: f64,
    /// Axes that the end-effector frame is to have: the first in the plane, three in space.
    axes: Vec<[f64; 3]>,
    /// Whether joints are to be at given positions: the pose of the plan at that time shows them.
    of_joints: bool,
}

/// Those of `problem`, in the order of time; `plan` says where the base is then.
pub(super) fn marks(problem: &Problem, plan: &Discretization) -> Vec<Mark> {
    let task = &problem.task;
    let fractions: Vec<f64> = std::iter::once(0.0)
        .chain(
            task.way_points
                .iter()
                .map(|point| point.fraction(&task.duration)),
        )
        .chain(std::iter::once(1.0))
        .collect();
    let rows = at_fractions(problem, plan, &fractions);
    let pose = |k: usize| base_pose(&problem.robot, &rows, k);
    let start = pose(0);
    let mut found = Vec::new();
    for (w, point) in task.way_points.iter().enumerate() {
        let label = format!("way-point {}", w + 1);
        let of_joints = point.joints.iter().any(Option::is_some);
        if of_joints || point.end_effector.is_some() {
            let goal = point.end_effector.as_ref();
            found.push(mark(
                problem,
                goal,
                [start, pose(w + 1)],
                label,
                fractions[w + 1],
                of_joints,
            ));
        }
    }
    let end = fractions.len() - 1;
    let of_joints = task.free_joints.iter().any(|free| !free);
    let goal = task.end_effector.as_ref();
    found.push(mark(
        problem,
        goal,
        [start, pose(end)],
        "goal".into(),
        1.0,
        of_joints,
    ));
    found
}

/// The mark of `goal`; `bases` are the base at t₀ and when it is to be met.
fn mark(
    problem: &Problem,
    goal: Option<&EndEffectorGoal>,
    bases: [BaseMotion; 2],
    label: String,
    part: f64,
    of_joints: bool,
) -> Mark {
    let robot = &problem.robot;
    let basis = from_picture(robot);
    let base = goal.and_then(|goal| match goal.frame {
        GoalFrame::Inertial => None,
        GoalFrame::Start => Some(bases[0]),
        GoalFrame::Base => Some(bases[1]),
    });
    let turned = |vector: Vector3<f64>| base.map_or(vector, |base| base.rotation * vector);
    let shown = |vector: Vector3<f64>| <[f64; 3]>::from(basis.transpose() * vector);
    let at = goal
        .and_then(|goal| goal.position.as_deref())
        .map(|position| {
            let mut point = Vector3::zeros();
            point.as_mut_slice()[..position.len()].copy_from_slice(position);
            let origin = base.map_or_else(Vector3::zeros, |base| base.position);
            shown(origin + turned(basis * point))
        });
    let axes = goal
        .and_then(|goal| goal.orientation.as_deref())
        .map(|angles| {
            let attitude = orientation(robot, SpatialAttitude::RollPitchYaw, angles);
            let count = if robot.plane().is_some() { 1 } else { 3 };
            let axis = |i: usize| shown(turned(attitude * basis.column(i).into_owned()));
            (0..count).map(axis).collect()
        });
    Mark {
        label,
        part,
        at,
        within: goal.map_or(0.0, |goal| goal.position_tolerance),
        axes: axes.unwrap_or_default(),
        of_joints,
    }
}
