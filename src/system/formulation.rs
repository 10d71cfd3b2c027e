//! Names and bounds of states, controls and rows, and what limit each belongs to.

use super::plant::Plant;
use super::rows::{
    BoundId, Component, EndBlock, EndRows, PathBlock, PathRows, PeakRow, Row, WayPointRows, held,
    of_joint,
};
use crate::dynamics::JointKind;
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
        let [along, last] = attitude_bounds(problem, plant);
        let attitude = |limit, bounds| attitude_rows(plant, limit, bounds);
        let joint = |limit, what, unit, bounds: &[Interval]| {
            joint_rows(problem, (limit, what, unit), bounds)
        };
        let position = joint(
            LimitId::JointPosition,
            "position",
            Unit::position,
            &limits.joint_position,
        );
        let rate = joint(
            LimitId::JointVelocity,
            "rate",
            Unit::rate,
            &limits.joint_velocity,
        );
        let goal = joint(
            LimitId::FinalJoints,
            "position",
            Unit::position,
            &goal(problem),
        );
        let rest = vec![Interval::fixed(0.0); plant.joints()];
        let rest = joint(LimitId::FinalJoints, "rate", Unit::rate, &rest);
        Self {
            states: [attitude(LimitId::BaseAttitude, &along), position, rate].concat(),
            terminal: [attitude(LimitId::FinalBaseAttitude, &last), goal, rest].concat(),
            controls: joint(
                LimitId::Control,
                "control",
                Unit::acceleration,
                &limits.control,
            ),
            path: path.iter().flat_map(PathRows::rows).cloned().collect(),
            boundary: (end.iter().flat_map(EndRows::rows).cloned())
                .chain(base_motion(problem))
                .collect(),
        }
    }
}

/// The row of what the cost counts of the base, the last of the end.
fn base_motion(problem: &Problem) -> Option<Row> {
    let most = problem.limits.base_motion;
    most.is_finite().then(|| {
        let id = BoundId::new(LimitId::BaseMotion, Component::BaseMotion);
        let bounds = Interval::new(f64::NEG_INFINITY, most);
        let row = Row::new(id, Unit::One, LimitId::BaseMotion.words(), bounds).sized(most);
        row.scaled(most)
    })
}

/// Rows of the attitude parameters.
fn attitude_rows<Sp: Space>(plant: &Plant<Sp>, limit: LimitId, bounds: &[Interval]) -> Vec<Row> {
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
}

/// Rows with one component a joint: the limit, what a person calls it, its unit.
fn joint_rows(
    problem: &Problem,
    (limit, what, unit): (LimitId, &str, fn(JointKind) -> Unit),
    bounds: &[Interval],
) -> Vec<Row> {
    let joints = problem.robot.joints();
    let rows = bounds.iter().enumerate();
    rows.map(|(j, bounds)| {
        let component = match limit {
            LimitId::JointVelocity => Component::JointRate(j),
            _ => Component::Joint(j),
        };
        let id = BoundId::new(limit, component);
        let name = of_joint(what, &joints[j]);
        Row::new(id, unit(joints[j].kind), name, *bounds)
    })
    .collect()
}

/// Joint positions at t_f, free where they are for the planner to find.
fn goal(problem: &Problem) -> Vec<Interval> {
    let task = &problem.task;
    let joints = task.final_joints.iter().zip(&task.free_joints);
    joints
        .map(|(&at, &free)| match free {
            true => Interval::FREE,
            false => Interval::fixed(at),
        })
        .collect()
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
    let start = plant.start_attitude.iter();
    let initial = start
        .chain(&task.initial_joints)
        .chain(&task.initial_rates)
        .copied();
    let formulation = Formulation {
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
        ..Formulation::default()
    };
    // Starts bring their own peaks; one stands for those that are not known.
    let peaks = PeakRow::all(problem).into_iter();
    let formulation = peaks.fold(formulation, |formulation, peak| {
        formulation.parameter(peak.quantity(), 1.0)
    });
    let most = problem.limits.base_motion;
    match most.is_finite() {
        true => formulation
            .integral(Quantity::new("base motion along the path", Interval::FREE).scaled(most)),
        false => formulation,
    }
}
