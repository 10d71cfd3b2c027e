//! The base's pose and velocity in space, also of planar robots.

use crate::dynamics::Model;
use crate::dynamics::attitude::SpatialAttitude;
use crate::problem::Problem;
use crate::system::Trajectory;
use crate::verify::bodies::{BaseMotion, Bodies, orientation};
use nalgebra::{UnitQuaternion, Vector3};

/// The base at one instant. Its frame is that of the robot's root link; inertial axes are those of the
/// base at attitude zero, their origin is the system's mass centre at the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BaseSample {
    /// Position of the base frame's origin, inertial axes, m.
    pub position: [f64; 3],
    /// From base axes to inertial axes: w, x, y, z, of norm 1.
    pub quaternion: [f64; 4],
    /// Velocity of that origin, inertial axes, m/s.
    pub velocity: [f64; 3],
    /// Angular velocity, base axes, rad/s.
    pub angular_velocity: [f64; 3],
}

/// The base at every row of `motion`.
pub(super) fn base_samples(problem: &Problem, motion: &Trajectory) -> Vec<BaseSample> {
    let robot = &problem.robot;
    let mut bodies = Bodies::new(robot);
    let drift = center_velocity(problem);
    let mut last: Option<UnitQuaternion<f64>> = None;
    let mut samples = Vec::with_capacity(motion.t.len());
    for k in 0..motion.t.len() {
        let attitude = motion.attitude.unwrap_or(SpatialAttitude::RollPitchYaw);
        let mut turn = orientation(robot, attitude, &motion.base_attitude[k]);
        // Both signs are one orientation: that nearer to the one before, so that the curve is smooth.
        if last.is_some_and(|last| last.coords.dot(&turn.coords) < 0.0) {
            turn = UnitQuaternion::new_unchecked(-turn.into_inner());
        }
        last = Some(turn);
        let omega = angular_velocity(robot, attitude, motion, k);
        let mut base = BaseMotion::placed(position(robot, motion, k, &turn), turn);
        base.angular = turn * omega;
        // The base's origin moves as makes the system's mass centre move as it does.
        bodies.update(
            robot,
            &base,
            &motion.joint_position[k],
            &motion.joint_velocity[k],
        );
        let velocity = drift - bodies.linear_momentum() / robot.total_mass();
        let quaternion = turn.coords;
        samples.push(BaseSample {
            position: base.position.into(),
            quaternion: [quaternion.w, quaternion.x, quaternion.y, quaternion.z],
            velocity: velocity.into(),
            angular_velocity: omega.into(),
        });
    }
    samples
}

/// Velocity of the system's mass centre, inertial axes, m/s.
fn center_velocity(problem: &Problem) -> Vector3<f64> {
    let robot = &problem.robot;
    in_space(robot, &problem.task.initial_momentum.linear) / robot.total_mass()
}

/// A vector that has two components in the plane of a planar robot.
fn in_space(robot: &Model, components: &[f64]) -> Vector3<f64> {
    match (robot.plane(), components) {
        (Some(plane), [x, y]) => plane.basis * Vector3::new(*x, *y, 0.0),
        (_, [x, y, z]) => Vector3::new(*x, *y, *z),
        _ => Vector3::zeros(),
    }
}

fn position(
    robot: &Model,
    motion: &Trajectory,
    k: usize,
    turn: &UnitQuaternion<f64>,
) -> Vector3<f64> {
    let within = in_space(robot, &motion.base_position[k]);
    match robot.plane() {
        // All mass centres lie in one plane, the base frame may lie beside it.
        Some(plane) => {
            let normal = plane.basis.column(2);
            let height = normal.dot(robot.base().inertia.center());
            within - turn * normal.into_owned() * height
        }
        None => within,
    }
}

/// Angular velocity, base axes, rad/s.
fn angular_velocity(
    robot: &Model,
    attitude: SpatialAttitude,
    motion: &Trajectory,
    k: usize,
) -> Vector3<f64> {
    let (eta, rates) = (&motion.base_attitude[k], &motion.base_rate[k]);
    match (robot.plane(), attitude) {
        (Some(plane), _) => plane.basis.column(2) * rates[0],
        (None, SpatialAttitude::RollPitchYaw) => {
            let (sin_roll, cos_roll) = eta[0].sin_cos();
            let (sin_pitch, cos_pitch) = eta[1].sin_cos();
            Vector3::new(
                rates[0] - sin_pitch * rates[2],
                cos_roll * rates[1] + cos_pitch * sin_roll * rates[2],
                -sin_roll * rates[1] + cos_pitch * cos_roll * rates[2],
            )
        }
        (None, _) => Vector3::from_column_slice(rates),
    }
}
