//! The robot as its maker describes it: a tree of bodies joined by one-axis joints.

use super::planarity::{self, Deviation, Plane};
use super::{Body, EndEffector, InertiaError, Joint, Placement, massless};
use std::collections::HashSet;

/// A robot that cannot be.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
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
    /// A joint farther from its carrier than anything is.
    #[error(
        "joint '{joint}' is {distance:e} m from the frame that carries it, expected at most {:e} m",
        super::MOST_LENGTH
    )]
    TooFar {
        /// Name of the joint.
        joint: String,
        /// The distance, m.
        distance: f64,
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
    MasslessJoint {
        /// Name of the joint.
        joint: String,
        /// Name of the body it moves.
        body: String,
    },
    /// A body's mass properties.
    #[error("body '{body}': {cause}")]
    Inertia {
        /// Name of the body.
        body: String,
        /// What is wrong with it.
        cause: InertiaError,
    },
}

/// A manipulator on a floating base: immutable once built.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    name: String,
    base: Body,
    joints: Vec<Joint>,
    end_effector: Option<EndEffector>,
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
        let mut joint_names = HashSet::new();
        let mut body_names = HashSet::from([base.name.as_str()]);
        for (j, joint) in joints.iter().enumerate() {
            let distance = joint.placement.translation.amax();
            if distance.is_nan() || distance > super::MOST_LENGTH {
                return Err(ModelError::TooFar {
                    joint: joint.name.clone(),
                    distance,
                });
            }
            if joint.parent.is_some_and(|parent| parent >= j) {
                return Err(ModelError::Order {
                    joint: joint.name.clone(),
                });
            }
            if !joint_names.insert(joint.name.as_str()) {
                return Err(ModelError::DuplicateName(joint.name.clone()));
            }
            if !body_names.insert(joint.body.name.as_str()) {
                return Err(ModelError::DuplicateName(joint.body.name.clone()));
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
        match massless::always(&model.base, &model.joints) {
            Some(j) => Err(ModelError::MasslessJoint {
                joint: model.joints[j].name.clone(),
                body: model.joints[j].body.name.clone(),
            }),
            None => Ok(model),
        }
    }

    /// The same robot with an end-effector frame, placed in the body of a joint (or the base).
    pub fn with_end_effector(mut self, joint: Option<usize>, placement: Placement) -> Self {
        self.end_effector = Some(EndEffector { joint, placement });
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

    /// The end-effector frame; `None` where the robot has none.
    pub fn end_effector(&self) -> Option<&EndEffector> {
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
    pub fn massless_joint_at(&self, q: &[f64]) -> Option<usize> {
        massless::at(&self.base, &self.joints, q)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::{Inertia, JointKind, JointLimits};
    use nalgebra::{Matrix3, Unit, Vector3};

    fn body(name: &str, inertia: Inertia) -> Body {
        Body {
            name: name.into(),
            inertia,
        }
    }

    fn solid(mass: f64) -> Inertia {
        Inertia::new(mass, Vector3::new(0.1, 0.0, 0.0), Matrix3::identity()).unwrap()
    }

    /// A chain with the given axes and bodies, joints half a metre apart along x.
    fn chain(links: Vec<(Vector3<f64>, Inertia)>) -> Result<Model, ModelError> {
        let joint = |(j, (axis, inertia)): (usize, (Vector3<f64>, Inertia))| Joint {
            name: format!("joint{j}"),
            kind: JointKind::Revolute,
            parent: j.checked_sub(1),
            placement: Placement::from_xyz_rpy(
                [if j == 0 { 0.5 } else { 0.0 }, 0.0, 0.0],
                [0.0; 3],
            ),
            axis: Unit::new_normalize(axis),
            limits: JointLimits::NONE,
            body: body(&format!("link{j}"), inertia),
        };
        let joints = links.into_iter().enumerate().map(joint).collect();
        Model::new("chain", body("base", solid(50.0)), joints)
    }

    fn massless(result: Result<Model, ModelError>) -> String {
        match result {
            Err(ModelError::MasslessJoint { joint, .. }) => joint,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn massless_bodies_are_fine_between_joints_and_nowhere_else() {
        let none = Inertia::massless;
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        assert!(chain(vec![(z, none()), (y, none()), (x, solid(1.0))]).is_ok());
        assert_eq!(
            massless(chain(vec![(z, solid(1.0)), (y, none())])),
            "joint1"
        );
        assert_eq!(massless(chain(vec![(z, none()), (y, none())])), "joint0");
        // Two joints of one axis, nothing between them.
        assert_eq!(
            massless(chain(vec![(z, none()), (z, solid(1.0))])),
            "joint1"
        );
    }

    #[test]
    fn a_point_mass_is_moved_by_its_arm_and_not_by_its_own_axis() {
        let point = Inertia::part(1.0, Vector3::new(0.2, 0.0, 0.0), Matrix3::zeros()).unwrap();
        assert!(chain(vec![(Vector3::z(), point.clone())]).is_ok());
        assert_eq!(massless(chain(vec![(Vector3::x(), point)])), "joint0");
    }

    #[test]
    fn a_wrist_of_massless_bodies_is_singular_where_two_axes_meet() {
        let none = Inertia::massless;
        let (y, z) = (Vector3::y(), Vector3::z());
        let model = chain(vec![(z, none()), (y, none()), (z, solid(1.0))]).unwrap();
        assert_eq!(model.massless_joint_at(&[0.3, 0.0, 0.2]), Some(2));
        assert_eq!(model.massless_joint_at(&[0.3, 0.4, 0.2]), None);
    }

    #[test]
    fn a_base_needs_inertia() {
        let base = body("base", Inertia::massless());
        let joints = chain(vec![(Vector3::z(), solid(1.0))])
            .unwrap()
            .joints()
            .to_vec();
        let error = Model::new("r", base, joints).unwrap_err();
        assert!(error.to_string().contains("'base' has no mass"), "{error}");
    }
}
