//! Names and bounds of states, controls and rows, and what limit each belongs to.

use super::plant::Plant;
use super::rows::{
    BoundId, Component, EndBlock, EndRows, PathBlock, PathRows, Row, WayPointRows, held,
};
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::ocp::{Formulation, Interval, Quantity};
use crate::problem::{LimitId, Problem, Unit};

/// Everything that is bounded, with the limit it belongs to; in the order of the programme.
#[derive(Debug, Clone)]
pub(crate) struct Bounded {
    /// States along the path.
    pub states: Vec<Row>,
    /// States at t_f.
    pub terminal: Vec<Row>,
    pub controls: Vec<Row>,
    pub path: Vec<Row>,
    pub boundary: Vec<Row>,
}

impl Bounded {
    pub fn new<Sp: Space>(
        problem: &Problem,
        plant: &Plant<Sp>,
        path: &[PathBlock<Sp>],
        end: &[EndBlock<Sp>],
    ) -> Self {
        let limits = &problem.limits;
        let task = &problem.task;
        let joints = problem.robot.joints();
        let [along, last] = attitude_bounds(problem, plant);
        let attitude = |limit, bounds: &[Interval]| -> Vec<Row> {
            let rows = bounds.iter().zip(plant.attitude.names()).enumerate();
            rows.map(|(i, (bounds, name))| {
                let component = match plant.attitude.is_angles() {
                    true => Component::Attitude(i),
                    // All that bounds the rotation angle gives way together.
                    false => Component::RotationAngle,
                };
                let id = BoundId::new(limit, component);
                Row::new(id, Unit::Radian, *name, *bounds)
            })
            .collect()
        };
        let joint = |limit, what: &str, unit: fn(_) -> Unit, bounds: &[Interval]| -> Vec<Row> {
            let rows = bounds.iter().enumerate();
            rows.map(|(j, bounds)| {
                let component = match limit {
                    LimitId::JointVelocity => Component::JointRate(j),
                    _ => Component::Joint(j),
                };
                let id = BoundId::new(limit, component);
                let name = format!("joint {} {what}", j + 1);
                Row::new(id, unit(joints[j].kind), name, *bounds)
            })
            .collect()
        };
        let goal: Vec<Interval> = task
            .final_joints
            .iter()
            .zip(&task.free_joints)
            .map(|(&at, &free)| {
                if free {
                    Interval::FREE
                } else {
                    Interval::fixed(at)
                }
            })
            .collect();
        let rest = vec![Interval::fixed(0.0); joints.len()];
        Self {
            states: [
                attitude(LimitId::BaseAttitude, &along),
                joint(
                    LimitId::JointPosition,
                    "position",
                    Unit::position,
                    &limits.joint_position,
                ),
                joint(
                    LimitId::JointVelocity,
                    "rate",
                    Unit::rate,
                    &limits.joint_velocity,
                ),
            ]
            .concat(),
            terminal: [
                attitude(LimitId::FinalBaseAttitude, &last),
                joint(LimitId::FinalJoints, "position", Unit::position, &goal),
                joint(LimitId::FinalJoints, "rate", Unit::rate, &rest),
            ]
            .concat(),
            controls: joint(
                LimitId::Control,
                "control",
                Unit::acceleration,
                &limits.control,
            ),
            path: path.iter().flat_map(PathRows::rows).cloned().collect(),
            boundary: end.iter().flat_map(EndRows::rows).cloned().collect(),
        }
    }
}

/// Bounds of the attitude parameters along the path and at t_f.
fn attitude_bounds<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> [Vec<Interval>; 2] {
    let limits = &problem.limits;
    let Some(held) = held(problem, plant) else {
        return [&limits.base_attitude, &limits.final_base_attitude].map(Vec::clone);
    };
    held.map(|held| {
        let bound = |&start: &f64| match held && start == 0.0 {
            true => Interval::fixed(0.0),
            false => Interval::FREE,
        };
        plant.attitude.start().iter().map(bound).collect()
    })
}

/// The formulation of `problem` from what is bounded in it.
pub(crate) fn formulation<Sp: Space>(
    problem: &Problem,
    plant: &Plant<Sp>,
    bounded: &Bounded,
    way_points: &[WayPointRows<Sp>],
) -> Formulation {
    let quantities =
        |rows: &[Row]| -> Vec<Quantity> { rows.iter().map(|row| row.quantity.clone()).collect() };
    let task = &problem.task;
    let start = plant.attitude.start().iter();
    let initial = start
        .chain(&task.initial_joints)
        .chain(&task.initial_rates)
        .copied();
    Formulation {
        states: quantities(&bounded.states),
        controls: quantities(&bounded.controls),
        path: quantities(&bounded.path),
        boundary: quantities(&bounded.boundary),
        initial: initial.map(Interval::fixed).collect(),
        terminal: bounded
            .terminal
            .iter()
            .map(|row| row.quantity.bounds)
            .collect(),
        duration: task.duration,
        way_points: way_points.iter().map(WayPointRows::formulate).collect(),
    }
}
