//! Task-space goals: where the end effector is to be at t_f or at a way-point.

/// The frame a task-space goal is given in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
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
}
