//! Rows of a goal for the end effector, at t_f or at a way-point.

use crate::autodiff::Scalar;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::ocp::{Interval, Quantity};
use crate::problem::{EndEffectorGoal, GoalFrame};

/// The boundary rows of a goal.
#[derive(Debug, Clone)]
pub(crate) struct GoalRows<Sp: Space> {
    goal: EndEffectorGoal,
    orientation: Option<Sp::Orientation<f64>>,
    /// Base position at t₀, inertial.
    start: Sp::Linear<f64>,
}

impl<Sp: Space> GoalRows<Sp> {
    pub fn new(goal: &EndEffectorGoal, start: Sp::Linear<f64>) -> Self {
        Self {
            orientation: goal
                .orientation
                .as_deref()
                .map(|angles| Sp::Attitude::BY_ANGLES.orientation(angles)),
            goal: goal.clone(),
            start,
        }
    }

    /// Names and bounds: position along each axis, sines of the turn about each axis, its cosine.
    pub fn quantities(&self) -> Vec<Quantity> {
        let mut rows = Vec::new();
        for (axis, &value) in ["x", "y", "z"]
            .iter()
            .zip(self.goal.position.iter().flatten())
        {
            let room = self.goal.position_tolerance;
            let bounds = Interval::new(value - room, value + room);
            rows.push(Quantity::new(format!("end effector {axis}"), bounds));
        }
        if self.orientation.is_some() {
            let sine = self.goal.orientation_tolerance.sin();
            let axes: &[&str] = if Sp::ANGLES == 1 {
                &["heading"]
            } else {
                &["x", "y", "z"]
            };
            rows.extend(axes.iter().map(|axis| {
                let name = format!("end effector turn, {axis}");
                Quantity::new(name, Interval::symmetric(sine))
            }));
            // The sines vanish at half a turn as well.
            let cosine = Interval::new(0.0, f64::INFINITY);
            rows.push(Quantity::new("end effector not turned over", cosine));
        }
        rows
    }

    /// Distance from the position (m) and angle from the orientation (rad) behind values of the
    /// rows; `None` for what is no part of the goal.
    pub fn gap(&self, rows: &[f64]) -> (Option<f64>, Option<f64>) {
        let norm = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>().sqrt();
        let (at, turned) = rows.split_at(self.goal.position.as_ref().map_or(0, Vec::len));
        let distance = self.goal.position.as_ref().map(|wanted| {
            let apart: Vec<f64> = at.iter().zip(wanted).map(|(a, b)| a - b).collect();
            norm(&apart)
        });
        let angle = turned
            .split_last()
            .map(|(cosine, sines)| norm(sines).atan2(*cosine));
        (distance, angle)
    }

    /// The rows' values for the base attitude, the end effector's pose in the base frame and the
    /// system's mass centre; `carry` moves an inertial position with that mass centre.
    pub fn values<S: Scalar>(
        &self,
        (attitude, eta): (Sp::Attitude, &[S]),
        (orientation, position): (Sp::Orientation<S>, Sp::Linear<S>),
        system_center: &Sp::Linear<S>,
        carry: impl Fn(&mut [S]),
        rows: &mut [S],
    ) {
        let lengths = if self.goal.position.is_some() {
            Sp::LENGTHS
        } else {
            0
        };
        let (at, turned) = rows.split_at_mut(lengths);
        if lengths > 0 {
            let seen = match self.goal.frame {
                GoalFrame::Base => position,
                GoalFrame::Inertial | GoalFrame::Start => {
                    attitude.to_inertial(eta, &(position - *system_center))
                }
            };
            at.copy_from_slice(seen.components());
            if self.goal.frame != GoalFrame::Base {
                carry(at);
            }
            if self.goal.frame == GoalFrame::Start {
                for (value, &origin) in at.iter_mut().zip(self.start.components()) {
                    *value = *value - origin;
                }
            }
        }
        if let Some(goal) = &self.orientation {
            let seen = match self.goal.frame {
                GoalFrame::Base => orientation,
                GoalFrame::Inertial | GoalFrame::Start => attitude.orient(eta, &orientation),
            };
            Sp::turn_between(&seen, goal, turned);
        }
    }
}
