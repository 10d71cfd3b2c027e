//! The robot as its maker describes it: a tree of bodies joined by one-axis joints.

use super::planarity::{self, Deviation, Plane};
use super::{Inertia, InertiaError, inertness};
use nalgebra::{Matrix3, Rotation3, Unit, Vector3};

/// Pose of a frame in another: rotation and translation (m).
#[derive(Debug, Clone, PartialEq)]
pub struct Placement {
    /// Rotation matrix from the inner to the outer frame.
    pub rotation: Matrix3<f64>,
    /// Origin of the inner frame in the outer, m.
    pub translation: Vector3<f64>,
}

impl Placement {
    /// No rotation and no translation.
    pub fn identity() -> Self {
        Self {
            rotation: Matrix3::identity(),
            translation: Vector3::zeros(),
        }
    }

    /// From a translation `xyz` (m) and fixed-axis angles `rpy` (rad), as URDF's `<origin>`.
    pub fn from_xyz_rpy(xyz: [f64; 3], rpy: [f64; 3]) -> Self {
        Self {
            rotation: Rotation3::from_euler_angles(rpy[0], rpy[1], rpy[2]).into_inner(),
            translation: xyz.into(),
        }
    }

    /// The pose of a frame whose pose in this one is `inner`.
    pub fn then(&self, inner: &Self) -> Self {
        Self {
            rotation: self.rotation * inner.rotation,
            translation: self.translation + self.rotation * inner.translation,
        }
    }
}

/// What a joint lets its body do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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

/// A robot that cannot be.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// Nothing to plan.
    #[error("robot '{0}' has no joints; it needs at least one")]
    NoJoints(String),
    /// Two things of one name.
    #[error("the name '{0}' is given twice; joints and bodies need names of their own")]
    DuplicateName(String),
    /// A joint that comes before the one that carries it.
    #[error("joint '{joint}' comes before its parent; list joints from the base outwards")]
    Order {
        /// Name of the joint.
        joint: String,
    },
    /// A base that cannot carry anything.
    #[error(
        "base '{body}' {}; the base needs mass, and inertia about every axis",
        if *.mass == 0.0 { "has no mass" } else { "is a point mass or a thin rod" }
    )]
    Base {
        /// Name of the body.
        body: String,
        /// Its mass, kg.
        mass: f64,
    },
    /// A joint that moves nothing: its rate has no effect on anything.
    #[error(
        "joint '{joint}' can move without moving any mass: too little mass or inertia in body \
         '{body}' and what it carries"
    )]
    Inert {
        /// Name of the joint.
        joint: String,
        /// Name of the body it moves.
        body: String,
    },
    /// A body's mass properties.
    #[error("body '{body}': {source}")]
    Inertia {
        /// Name of the body.
        body: String,
        /// What is wrong with it.
        source: InertiaError,
    },
}

/// A manipulator on a floating base: immutable once built.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    name: String,
    base: Body,
    joints: Vec<Joint>,
    end_effector: Option<(Option<usize>, Placement)>,
    plane: Option<Plane>,
}

impl Model {
    /// A robot from its base body and its joints, listed from the base outwards.
    ///
    /// # Errors
    /// [`ModelError`] for no joints, names given twice, a joint before its parent, a base or a
    /// joint without inertia. Bodies between two joints may be massless.
    pub fn new(name: &str, base: Body, joints: Vec<Joint>) -> Result<Self, ModelError> {
        if joints.is_empty() {
            return Err(ModelError::NoJoints(name.into()));
        }
        for (j, joint) in joints.iter().enumerate() {
            if joint.parent.is_some_and(|parent| parent >= j) {
                return Err(ModelError::Order {
                    joint: joint.name.clone(),
                });
            }
            if joints[..j].iter().any(|other| other.name == joint.name) {
                return Err(ModelError::DuplicateName(joint.name.clone()));
            }
            let body = &joint.body.name;
            if base.name == *body || joints[..j].iter().any(|other| other.body.name == *body) {
                return Err(ModelError::DuplicateName(body.clone()));
            }
        }
        if !base.inertia.is_solid() {
            return Err(ModelError::Base {
                mass: base.inertia.mass(),
                body: base.name,
            });
        }
        let plane = planarity::detect(&base, &joints);
        let model = Self {
            name: name.into(),
            base,
            joints,
            end_effector: None,
            plane,
        };
        match inertness::always(&model) {
            Some(j) => Err(ModelError::Inert {
                joint: model.joints[j].name.clone(),
                body: model.joints[j].body.name.clone(),
            }),
            None => Ok(model),
        }
    }

    /// The same robot with an end-effector frame, placed in the body of a joint (or the base).
    pub fn with_end_effector(mut self, joint: Option<usize>, placement: Placement) -> Self {
        self.end_effector = Some((joint, placement));
        self
    }

    /// The same robot with its motion treated in space even where it is planar.
    ///
    /// For comparing the two: the base attitude then has three angles.
    pub fn in_space(mut self) -> Self {
        self.plane = None;
        self
    }

    /// Name of the robot.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The base body, the spacecraft.
    pub fn base(&self) -> &Body {
        &self.base
    }

    /// Joints with the bodies they move, from the base outwards; length n.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Number of joints n.
    pub fn joint_count(&self) -> usize {
        self.joints.len()
    }

    /// End-effector frame: the joint whose body carries it (`None`: the base) and its placement.
    pub fn end_effector(&self) -> Option<&(Option<usize>, Placement)> {
        self.end_effector.as_ref()
    }

    /// The plane of motion, where all motion stays in one.
    pub fn plane(&self) -> Option<&Plane> {
        self.plane.as_ref()
    }

    /// How far the robot is from moving in a plane; `None` where no joint turns.
    pub fn deviation_from_plane(&self) -> Option<Deviation> {
        planarity::measure(&self.base, &self.joints).map(|(_, deviation)| deviation)
    }

    /// The first joint that, together with those before it, can move at the joint positions `q`
    /// (rad or m, length n) without moving any mass; `None` where there is none, as in all robots
    /// whose bodies all have mass and size.
    ///
    /// The reduced inertia matrix H is singular there.
    pub fn inert_joint(&self, q: &[f64]) -> Option<usize> {
        inertness::at(self, q)
    }

    /// Mass of all bodies together, kg.
    pub fn total_mass(&self) -> f64 {
        let links: f64 = self
            .joints
            .iter()
            .map(|joint| joint.body.inertia.mass())
            .sum();
        self.base.inertia.mass() + links
    }
}
