//! Places at which the system's mass centre keeps the base out of the box it may be in.
//!
//! Joints alone do not move the mass centre. Where all their positions are given, the base is at a
//! known distance from it, and turns about it.
//!
//! Derived in docs/algorithms.md#displacement.

use crate::dynamics::Data;
use crate::dynamics::space::{Space, Vector};
use crate::ocp::Interval;
use crate::problem::{Impossible, Limits, Place, Problem};
use crate::system::plant::Plant;
use std::f64::consts::PI;

/// Part of its size by which the base may be outside: rounding, of the file as well.
const ROOM: f64 = 1e-6;

pub(super) fn reasons<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> Vec<Impossible> {
    if problem.limits.base_position.iter().all(Interval::is_free) {
        return Vec::new();
    }
    let task = &problem.task;
    let on_the_way = task.way_points.iter().enumerate().filter_map(|(i, point)| {
        let joints: Option<Vec<f64>> = point.joints.iter().copied().collect();
        Some((Place::WayPoint(i), joints?, point.fraction(&task.duration)))
    });
    let goal = (Place::Goal, task.final_joints.clone(), 1.0);
    let at_goal = (!task.free_joints.contains(&true)).then_some(goal);
    on_the_way
        .chain(at_goal)
        .filter_map(|(place, joints, fraction)| {
            let time = known_time(problem, fraction)?;
            outside(problem, plant, place, &joints, time)
        })
        .collect()
}

/// When the arm is at that fraction of the duration, s; any time where the mass centre is at rest.
fn known_time(problem: &Problem, fraction: f64) -> Option<f64> {
    let task = &problem.task;
    let rests = task.initial_momentum.linear.iter().all(|p| *p == 0.0);
    (rests || task.duration.is_fixed()).then_some(fraction * task.duration.upper)
}

/// How far outside of its box the base is at `place`, at the least.
fn outside<Sp: Space>(
    problem: &Problem,
    plant: &Plant<Sp>,
    place: Place,
    joints: &[f64],
    time: f64,
) -> Option<Impossible> {
    let mut data = Data::<Sp, f64>::new(&plant.tree);
    plant.tree.kinematics(joints, &mut data);
    plant.tree.momentum(&mut data);
    let arm = data.system_center;
    // The base is at −R·arm from the mass centre.
    let radius = arm.dot(&arm).sqrt();
    let mut center = plant.start_position.times(-1.0);
    plant.drift.carry(time, center.components_mut());
    let bounds = &problem.limits.base_position;
    let room = ROOM * (radius + center.dot(&center).sqrt());

    let at_any_attitude = apart(bounds, &center, radius);
    let turned = largest_turn(&problem.limits, place);
    let moved = 2.0 * radius * (0.5 * turned.min(PI)).sin();
    let at_these = nearest(bounds, &(center - arm)) - moved;
    let (turned, outside) = match at_these > at_any_attitude {
        true => (Some(turned), at_these),
        false => (None, at_any_attitude),
    };
    (outside > room).then_some(Impossible::BaseDisplacement {
        place,
        turned,
        outside,
    })
}

/// How far the box is from all points at the distance `radius` from `center`; below zero where it has
/// such points.
fn apart<V: Vector<f64>>(bounds: &[Interval], center: &V, radius: f64) -> f64 {
    let farthest = bounds.iter().zip(center.components()).map(|(bound, c)| {
        let side = (bound.lower - c).abs().max((bound.upper - c).abs());
        side * side
    });
    let farthest = farthest.sum::<f64>().sqrt();
    (nearest(bounds, center) - radius).max(radius - farthest)
}

/// The distance of `point` from the box.
fn nearest<V: Vector<f64>>(bounds: &[Interval], point: &V) -> f64 {
    let sides = bounds.iter().zip(point.components());
    let squares = sides.map(|(bound, c)| bound.violation(*c).powi(2));
    squares.sum::<f64>().sqrt()
}

/// The largest rotation angle that the limits on the attitude allow at `place`, rad: angles about
/// several axes add up at most.
fn largest_turn(limits: &Limits, place: Place) -> f64 {
    let turn = |angles: &[Interval]| -> f64 {
        let largest = |angle: &Interval| angle.lower.abs().max(angle.upper.abs());
        angles.iter().map(largest).sum()
    };
    let along = turn(&limits.base_attitude);
    match place {
        Place::Goal => along.min(turn(&limits.final_base_attitude)),
        _ => along,
    }
}
