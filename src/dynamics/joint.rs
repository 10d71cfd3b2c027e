//! Bodies and the joints that move them, as the robot's maker describes them.

use super::{Inertia, Placement};
use nalgebra::{Unit, Vector3};

/// What a joint lets its body do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum JointKind {
    /// Turn about the axis; position in rad.
    Revolute,
    /// Slide along the axis; position in m.
    Prismatic,
}

/// Limits of a joint as the robot's maker gives them; infinite where there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointLimits {
    /// Lowest and highest position, rad or m.
    pub position: [f64; 2],
    /// Largest speed, rad/s or m/s.
    pub velocity: f64,
    /// Largest torque or force, N·m or N.
    pub effort: f64,
}

impl JointLimits {
    /// No limit at all.
    pub const NONE: Self = Self {
        position: [f64::NEG_INFINITY, f64::INFINITY],
        velocity: f64::INFINITY,
        effort: f64::INFINITY,
    };
}

/// A rigid body with its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Name, unique in the robot.
    pub name: String,
    /// Mass properties in the body's frame.
    pub inertia: Inertia,
}

/// A joint and the body it moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Name, unique in the robot.
    pub name: String,
    /// Turn or slide.
    pub kind: JointKind,
    /// The joint whose body carries this one; `None` for the base.
    pub parent: Option<usize>,
    /// Pose of the joint frame in the parent body's frame, at position zero.
    pub placement: Placement,
    /// Axis in the joint frame.
    pub axis: Unit<Vector3<f64>>,
    /// Limits from the robot's description.
    pub limits: JointLimits,
    /// The body it moves; its frame is the joint frame, moved by the joint.
    pub body: Body,
}

/// Where the end effector is.
#[derive(Debug, Clone, PartialEq)]
pub struct EndEffector {
    /// The joint whose body carries it; `None` for the base.
    pub joint: Option<usize>,
    /// Pose of its frame in the body's frame.
    pub placement: Placement,
}
