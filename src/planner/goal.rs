//! Task-space goals: where the end effector is to be at t_f or at a way-point.

use super::Problem;
use super::problem::{ProblemError, count, error, indexed};
use crate::autodiff::Scalar;
use crate::dynamics::Model;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::ocp::{Interval, Quantity};

/// The frame a task-space goal is given in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GoalFrame {
    /// Inertial axes, origin where the system's mass centre is at t₀ (Remark 1).
    Inertial,
    /// The base frame as it is at t₀, fixed in inertial space from then on.
    Start,
    /// The base frame as it is at t_f, or at the way-point.
    Base,
}

impl GoalFrame {
    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Inertial => "inertial",
            Self::Start => "start",
            Self::Base => "base",
        }
    }
}

/// Position, orientation or both of the end-effector frame.
#[derive(Debug, Clone, PartialEq)]
pub struct EndEffectorGoal {
    /// The frame that position and orientation are given in.
    pub frame: GoalFrame,
    /// Position, m: two lengths in the plane, three in space.
    pub position: Option<Vec<f64>>,
    /// Allowed distance from the position along each axis, m; 0 for exactly there.
    pub position_tolerance: f64,
    /// Orientation, rad: the heading of the frame's x axis in the plane, roll-pitch-yaw in space.
    pub orientation: Option<Vec<f64>>,
    /// Allowed angle from the orientation about each axis, rad, below π/2; 0 for exactly so.
    pub orientation_tolerance: f64,
}

impl EndEffectorGoal {
    /// Exactly at `position` (m), whatever the orientation.
    pub fn at(frame: GoalFrame, position: &[f64]) -> Self {
        Self {
            frame,
            position: Some(position.into()),
            position_tolerance: 0.0,
            orientation: None,
            orientation_tolerance: 0.0,
        }
    }

    /// Checks the goal of `robot` that stands under `key`.
    pub(super) fn validate(&self, key: &str, robot: &Model) -> Result<(), ProblemError> {
        let (angles, lengths) = Problem::base_sizes(robot);
        if robot.end_effector().is_none() {
            let expected = "a robot with an end effector";
            return Err(error(key, "a goal for the end effector", expected));
        }
        if self.position.is_none() && self.orientation.is_none() {
            return Err(error(key, "neither", "a position, an orientation or both"));
        }
        for (name, values, size, what) in [
            ("position", &self.position, lengths, "base lengths"),
            ("orientation", &self.orientation, angles, "base angles"),
        ] {
            let key = format!("{key}.{name}");
            if let Some(values) = values {
                count(&key, values.len(), size, what)?;
                for (i, value) in values.iter().enumerate() {
                    if !value.is_finite() {
                        return Err(error(indexed(&key, i, size), value, "a finite number"));
                    }
                }
            }
        }
        let room = self.position_tolerance;
        if !(room.is_finite() && room >= 0.0) {
            let key = format!("{key}.position_tolerance");
            return Err(error(key, room, "a finite length, m, zero or above"));
        }
        let room = self.orientation_tolerance;
        if !(0.0..1.5).contains(&room) {
            let key = format!("{key}.orientation_tolerance");
            return Err(error(key, room, "an angle from 0 to below 1.5 rad"));
        }
        Ok(())
    }
}

/// The boundary rows of a goal.
#[derive(Debug, Clone)]
pub(super) struct GoalRows<Sp: Space> {
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
