//! A way-point as the optimal control problem has it: bounds on the states there, and the rows of
//! a goal for the end effector.

use super::{BoundId, Component, EndEffectorRows, EndRows, Row, of_joint};
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::ocp::{self, Interval};
use crate::problem::{LimitId, Problem, Unit};
use crate::system::plant::Plant;

/// Sizes as those of a goal: a tenth of a radian or a metre.
const SIZE: f64 = 0.1;

/// A way-point compiled for evaluation.
#[derive(Debug, Clone)]
pub(crate) struct WayPointRows<Sp: Space> {
    /// What the state is held to there, one a state; free intervals for the base.
    pub states: Vec<Row>,
    /// The goal for the end effector.
    pub goal: Option<EndEffectorRows<Sp>>,
    fraction: f64,
}

/// Way-point `index` of `problem`.
pub(crate) fn way_point<Sp: Space>(
    problem: &Problem,
    plant: &Plant<Sp>,
    index: usize,
) -> WayPointRows<Sp> {
    let point = &problem.task.way_points[index];
    let limit = LimitId::WayPoint(index);
    let place = format!(", way-point {}", index + 1);
    let joints = problem.robot.joints();
    let row = |component, unit, name: String, at: Option<f64>| {
        let bounds = at.map_or(Interval::FREE, Interval::fixed);
        let id = BoundId::new(limit, component);
        Row::new(id, unit, format!("{name}{place}"), bounds).sized(SIZE)
    };
    let attitude = (0..plant.parameters()).map(|i| {
        let name = plant.attitude.names()[i].to_owned();
        row(Component::Attitude(i), Unit::Radian, name, None)
    });
    let positions = point.joints.iter().enumerate().map(|(j, &at)| {
        let name = of_joint("position", &joints[j]);
        let unit = Unit::position(joints[j].kind);
        row(Component::Joint(j), unit, name, at)
    });
    let rates = point.joint_rates.iter().enumerate().map(|(j, &at)| {
        let name = of_joint("rate", &joints[j]);
        let unit = Unit::rate(joints[j].kind);
        row(Component::JointRate(j), unit, name, at)
    });
    WayPointRows {
        states: attitude.chain(positions).chain(rates).collect(),
        goal: point
            .end_effector
            .as_ref()
            .map(|goal| EndEffectorRows::new(goal, plant, limit, &place)),
        fraction: point.fraction(&problem.task.duration),
    }
}

impl<Sp: Space> WayPointRows<Sp> {
    /// Rows of the goal.
    pub fn rows(&self) -> &[Row] {
        self.goal.as_ref().map_or(&[], |goal| goal.rows())
    }

    /// The way-point of the formulation.
    pub fn formulate(&self) -> ocp::WayPoint {
        let bounds = |row: &Row| row.quantity.bounds;
        ocp::WayPoint {
            fraction: self.fraction,
            states: self.states.iter().map(bounds).collect(),
            rows: self.rows().iter().map(|row| row.quantity.clone()).collect(),
        }
    }

    /// Fraction of the duration at which it stands.
    pub fn fraction(&self) -> f64 {
        self.fraction
    }
}
