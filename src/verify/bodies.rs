//! Poses, velocities and momentum of every body by plain forward kinematics, in inertial axes.
//!
//! Always in three dimensions, also for planar robots: what a plane takes for granted is seen
//! here if it does not hold.

use crate::dynamics::attitude::SpatialAttitude;
use crate::dynamics::{JointKind, Model};
use nalgebra::{Matrix3, Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};

/// Orientation of the base for the attitude η: a turn about the plane's normal, or as `attitude`
/// describes it in space.
pub fn orientation(model: &Model, attitude: SpatialAttitude, eta: &[f64]) -> UnitQuaternion<f64> {
    match (model.plane(), attitude) {
        (Some(plane), _) => {
            let normal = Unit::new_normalize(plane.basis.column(2).into_owned());
            UnitQuaternion::from_axis_angle(&normal, eta[0])
        }
        (None, SpatialAttitude::RollPitchYaw) => {
            let about = UnitQuaternion::from_axis_angle;
            about(&Vector3::z_axis(), eta[2])
                * about(&Vector3::y_axis(), eta[1])
                * about(&Vector3::x_axis(), eta[0])
        }
        (None, SpatialAttitude::Quaternion) => {
            UnitQuaternion::new_normalize(Quaternion::new(eta[0], eta[1], eta[2], eta[3]))
        }
        (None, SpatialAttitude::Mrp) => {
            let sigma = Vector3::from_column_slice(eta);
            let length = sigma.norm();
            let turn = if length > 0.0 {
                sigma * (4.0 * length.atan() / length)
            } else {
                sigma
            };
            UnitQuaternion::from_scaled_axis(turn)
        }
    }
}

/// The base frame's pose and motion in inertial axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BaseMotion {
    /// From base axes to inertial axes.
    pub rotation: Matrix3<f64>,
    /// Origin, m.
    pub position: Vector3<f64>,
    /// Velocity of the origin, m/s.
    pub velocity: Vector3<f64>,
    /// Angular velocity, rad/s.
    pub angular: Vector3<f64>,
}

impl BaseMotion {
    /// A base at rest.
    pub fn placed(position: Vector3<f64>, orientation: UnitQuaternion<f64>) -> Self {
        Self {
            rotation: orientation.to_rotation_matrix().into_inner(),
            position,
            velocity: Vector3::zeros(),
            angular: Vector3::zeros(),
        }
    }
}

/// One body at one instant, in inertial axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMotion {
    /// Mass, kg.
    pub mass: f64,
    /// Rotational inertia about the body's mass centre, kg m².
    pub inertia: Matrix3<f64>,
    /// From body axes to inertial axes.
    pub rotation: Matrix3<f64>,
    /// Axis of the joint that carries the body; zero for the base.
    pub axis: Vector3<f64>,
    /// Origin of the body frame, m.
    pub origin: Vector3<f64>,
    /// Velocity of that origin, m/s.
    pub origin_velocity: Vector3<f64>,
    /// Mass centre, m.
    pub center: Vector3<f64>,
    /// Velocity of the mass centre, m/s.
    pub velocity: Vector3<f64>,
    /// Angular velocity, rad/s.
    pub angular: Vector3<f64>,
}

impl BodyMotion {
    fn at_rest() -> Self {
        let zero = Vector3::zeros();
        Self {
            mass: 0.0,
            inertia: Matrix3::zeros(),
            rotation: Matrix3::identity(),
            axis: zero,
            origin: zero,
            origin_velocity: zero,
            center: zero,
            velocity: zero,
            angular: zero,
        }
    }
}

/// All bodies at one instant: the base first, then those of the joints in the model's order.
#[derive(Debug, Clone)]
pub struct Bodies {
    motions: Vec<BodyMotion>,
}

impl Bodies {
    /// Room for the bodies of `model`.
    pub fn new(model: &Model) -> Self {
        Self {
            motions: vec![BodyMotion::at_rest(); model.joint_count() + 1],
        }
    }

    /// Moves all bodies to the base motion, joint positions `q` and joint rates `dq` (length n).
    pub fn update(&mut self, model: &Model, base: &BaseMotion, q: &[f64], dq: &[f64]) {
        let mut frame = BodyMotion {
            rotation: base.rotation,
            origin: base.position,
            origin_velocity: base.velocity,
            angular: base.angular,
            ..BodyMotion::at_rest()
        };
        self.motions[0] = with_mass(frame, &model.base().inertia);
        for (j, joint) in model.joints().iter().enumerate() {
            let parent = &self.motions[joint.parent.map_or(0, |p| p + 1)];
            let placed = parent.rotation * joint.placement.rotation;
            let mut arm = parent.rotation * joint.placement.translation;
            frame.axis = placed * joint.axis.as_ref();
            frame.angular = parent.angular;
            frame.rotation = placed;
            let mut slide = Vector3::zeros();
            match joint.kind {
                JointKind::Revolute => {
                    frame.rotation *= Rotation3::from_axis_angle(&joint.axis, q[j]).matrix();
                    frame.angular += frame.axis * dq[j];
                }
                JointKind::Prismatic => {
                    arm += frame.axis * q[j];
                    slide = frame.axis * dq[j];
                }
            }
            frame.origin = parent.origin + arm;
            frame.origin_velocity = parent.origin_velocity + parent.angular.cross(&arm) + slide;
            self.motions[j + 1] = with_mass(frame, &joint.body.inertia);
        }
    }

    /// The bodies, the base first; length n + 1.
    pub fn motions(&self) -> &[BodyMotion] {
        &self.motions
    }

    /// Mass centre of the whole system, m.
    pub fn center(&self) -> Vector3<f64> {
        let mass: f64 = self.motions.iter().map(|body| body.mass).sum();
        self.motions
            .iter()
            .map(|body| body.center * body.mass)
            .sum::<Vector3<f64>>()
            / mass
    }

    /// Rotational inertia of the whole system about its mass centre, all joints held, inertial axes, kg m².
    pub fn inertia(&self) -> Matrix3<f64> {
        let center = self.center();
        let of_body = |body: &BodyMotion| {
            let arm = body.center - center;
            let about = Matrix3::identity() * arm.norm_squared() - arm * arm.transpose();
            body.inertia + about * body.mass
        };
        self.motions.iter().map(of_body).sum()
    }

    /// Total linear momentum, kg m/s.
    pub fn linear_momentum(&self) -> Vector3<f64> {
        self.motions
            .iter()
            .map(|body| body.velocity * body.mass)
            .sum()
    }

    /// Total angular momentum about the system's mass centre, kg m²/s.
    pub fn angular_momentum(&self) -> Vector3<f64> {
        let center = self.center();
        self.motions
            .iter()
            .map(|body| {
                body.inertia * body.angular
                    + (body.center - center).cross(&(body.velocity * body.mass))
            })
            .sum()
    }

    /// Total kinetic energy, J.
    pub fn kinetic_energy(&self) -> f64 {
        self.motions
            .iter()
            .map(|body| {
                0.5 * (body.mass * body.velocity.norm_squared()
                    + body.angular.dot(&(body.inertia * body.angular)))
            })
            .sum()
    }
}

/// Fills in what depends on the body's mass properties.
fn with_mass(mut body: BodyMotion, inertia: &crate::dynamics::Inertia) -> BodyMotion {
    let arm = body.rotation * inertia.center();
    body.mass = inertia.mass();
    body.inertia = body.rotation * inertia.rotational() * body.rotation.transpose();
    body.center = body.origin + arm;
    body.velocity = body.origin_velocity + body.angular.cross(&arm);
    body
}
