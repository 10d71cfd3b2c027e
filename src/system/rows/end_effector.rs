//! Rows of a goal for the end effector, at t_f or at a way-point.

use super::{BoundId, Component, EndRows, Row};
use crate::autodiff::Scalar;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::ocp::Interval;
use crate::problem::{EndEffectorGoal, GoalFrame, LimitId, Problem, Unit};
use crate::system::instant::Pose;
use crate::system::plant::Plant;

/// A tenth of a metre or of a radian counts as one where a goal gives way: allowed distances are
/// small.
const SIZE: f64 = 0.1;

/// Position along each axis, sines of the rotation about each axis, its cosine.
#[derive(Debug, Clone)]
pub(crate) struct EndEffectorRows<Sp: Space> {
    goal: EndEffectorGoal,
    orientation: Option<Sp::Orientation<f64>>,
    rows: Vec<Row>,
}

impl<Sp: Space> EndEffectorRows<Sp> {
    /// Those of the goal at t_f.
    pub fn at_end(problem: &Problem, _plant: &Plant<Sp>) -> Option<Self> {
        let goal = problem.task.end_effector.as_ref()?;
        Some(Self::new(goal, LimitId::EndEffector, ""))
    }

    /// Those of `goal`, which belong to `limit`; `place` follows their names.
    pub fn new(goal: &EndEffectorGoal, limit: LimitId, place: &str) -> Self {
        let row = |component, unit, name: String, bounds| {
            let id = BoundId::new(limit, component);
            Row::new(id, unit, format!("{name}{place}"), bounds).sized(SIZE)
        };
        let mut rows = Vec::new();
        let axes = ["x", "y", "z"];
        for (i, &value) in goal.position.iter().flatten().enumerate() {
            let room = goal.position_tolerance;
            let bounds = Interval::new(value - room, value + room);
            let name = format!("end effector {}", axes[i]);
            rows.push(row(Component::Position(i), Unit::Metre, name, bounds));
        }
        if goal.orientation.is_some() {
            let sine = goal.orientation_tolerance.sin();
            let axes: &[&str] = if Sp::ANGLES == 1 { &["heading"] } else { &axes };
            rows.extend(axes.iter().enumerate().map(|(i, axis)| {
                let name = format!("end effector rotation, {axis}");
                let bounds = Interval::symmetric(sine);
                row(Component::Orientation(i), Unit::One, name, bounds)
            }));
            // The sines vanish at half a turn as well.
            let cosine = Interval::new(0.0, f64::INFINITY);
            let name = "end effector not turned over".into();
            rows.push(row(Component::NotReversed, Unit::One, name, cosine));
        }
        Self {
            orientation: goal
                .orientation
                .as_deref()
                .map(|angles| Sp::Attitude::BY_ANGLES.orientation(angles)),
            goal: goal.clone(),
            rows,
        }
    }

    /// Distance from the position (m) and angle from the orientation (rad) behind values of the
    /// rows; `None` for what is no part of the goal.
    pub fn gap(&self, values: &[f64]) -> (Option<f64>, Option<f64>) {
        let norm = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>().sqrt();
        let (at, turned) = values.split_at(self.goal.position.as_ref().map_or(0, Vec::len));
        let distance = self.goal.position.as_ref().map(|wanted| {
            let apart: Vec<f64> = at.iter().zip(wanted).map(|(a, b)| a - b).collect();
            norm(&apart)
        });
        let angle = turned
            .split_last()
            .map(|(cosine, sines)| norm(sines).atan2(*cosine));
        (distance, angle)
    }
}

impl<Sp: Space> EndRows<Sp> for EndEffectorRows<Sp> {
    fn rows(&self) -> &[Row] {
        &self.rows
    }

    fn values<S: Scalar>(&self, at: &Pose<'_, Sp, S>, rows: &mut [S]) {
        let Some((orientation, position)) = at.plant.tree.end_effector(at.data) else {
            return;
        };
        let attitude = at.plant.attitude;
        let lengths = self.goal.position.as_ref().map_or(0, |_| Sp::LENGTHS);
        let (point, turned) = rows.split_at_mut(lengths);
        if lengths > 0 {
            let seen = match self.goal.frame {
                GoalFrame::Base => position,
                GoalFrame::Inertial | GoalFrame::Start => {
                    attitude.to_inertial(at.eta, &(position - at.data.system_center))
                }
            };
            point.copy_from_slice(seen.components());
            if self.goal.frame != GoalFrame::Base {
                at.plant.drift.carry(at.t, point);
            }
            if self.goal.frame == GoalFrame::Start {
                let start = at.plant.start_position.components();
                for (value, &origin) in point.iter_mut().zip(start) {
                    *value -= origin;
                }
            }
        }
        if let Some(goal) = &self.orientation {
            let seen = match self.goal.frame {
                GoalFrame::Base => orientation,
                GoalFrame::Inertial | GoalFrame::Start => attitude.orient(at.eta, &orientation),
            };
            Sp::rotation_between(&seen, goal, turned);
        }
    }
}
