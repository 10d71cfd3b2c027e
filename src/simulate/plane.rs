//! The robot as bodies in its plane.

use super::platform::Payload;
use crate::dynamics::{Inertia, JointKind, Model};
use nalgebra::{Matrix3, Vector2, Vector3};

/// One body with the joint that carries it. Body frames are all aligned at zero positions.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanarBody {
    /// The body that carries it; the base carries itself.
    pub parent: usize,
    /// Turn or slide; unused for the base.
    pub kind: JointKind,
    /// Sense of turning about the plane's normal.
    pub sign: f64,
    /// Joint origin in the parent's frame, m.
    pub offset: Vector2<f64>,
    /// Direction of sliding.
    pub slide: Vector2<f64>,
    /// Mass, kg.
    pub mass: f64,
    /// Mass centre in the body's frame, m.
    pub center: Vector2<f64>,
    /// Rotational inertia about the mass centre and the normal, kg m².
    pub inertia: f64,
    /// From the frame in the robot's file to the one here.
    frame: Matrix3<f64>,
}

/// All bodies, the base first.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanarBodies {
    bodies: Vec<PlanarBody>,
}

impl PlanarBodies {
    /// The planar form of a model, or `None` where its motion leaves the plane.
    pub fn new(model: &Model) -> Option<Self> {
        let to_plane = model.plane()?.basis.transpose();
        let normal = to_plane.row(2).transpose();
        let flat = |v: &Vector3<f64>| (to_plane * v).xy();
        let spin = |inertia: &Inertia, rotation: &Matrix3<f64>| {
            let axis = rotation.transpose() * normal;
            axis.dot(&(inertia.rotational() * axis))
        };
        let base = &model.base().inertia;
        let level = Matrix3::identity();
        let mut bodies = vec![PlanarBody {
            parent: 0,
            kind: JointKind::Revolute,
            sign: 1.0,
            offset: Vector2::zeros(),
            slide: Vector2::zeros(),
            mass: base.mass(),
            center: flat(base.center()),
            inertia: spin(base, &level),
            frame: to_plane,
        }];
        // Rotation of each body's frame in the base's with all joints at zero.
        let mut rotations = vec![level];
        for joint in model.joints() {
            let parent = joint.parent.map_or(0, |p| p + 1);
            let rotation = rotations[parent] * joint.placement.rotation;
            let axis = rotation * joint.axis.as_ref();
            let inertia = &joint.body.inertia;
            bodies.push(PlanarBody {
                parent,
                kind: joint.kind,
                sign: axis.dot(&normal).signum(),
                offset: flat(&(rotations[parent] * joint.placement.translation)),
                slide: flat(&axis),
                mass: inertia.mass(),
                center: flat(&(rotation * inertia.center())),
                inertia: spin(inertia, &rotation),
                frame: to_plane * rotation,
            });
            rotations.push(rotation);
        }
        Some(Self { bodies })
    }

    /// The same robot with `payload` fixed to its base.
    pub fn carrying(mut self, payload: &Payload) -> Self {
        let at = self.flat(0, &payload.at);
        let base = &mut self.bodies[0];
        let mass = base.mass + payload.mass;
        let center = (base.center * base.mass + at * payload.mass) / mass;
        base.inertia += payload.inertia
            + base.mass * (base.center - center).norm_squared()
            + payload.mass * (at - center).norm_squared();
        base.mass = mass;
        base.center = center;
        self
    }

    /// The bodies, the base first; length n + 1.
    pub fn bodies(&self) -> &[PlanarBody] {
        &self.bodies
    }

    /// Number of joints n.
    pub fn joint_count(&self) -> usize {
        self.bodies.len() - 1
    }

    /// Mass of all bodies, kg.
    pub fn total_mass(&self) -> f64 {
        self.bodies.iter().map(|body| body.mass).sum()
    }

    /// A point given in the frame of `body` as its file has it (m), in the plane.
    pub fn flat(&self, body: usize, point: &[f64; 3]) -> Vector2<f64> {
        (self.bodies[body].frame * Vector3::from(*point)).xy()
    }
}
