//! Finds out whether all motion of a robot stays in one plane.

use super::{Body, Inertia, Joint, JointKind};
use nalgebra::{Matrix3, Vector3};

/// Rounding allowed for in directions, heights (m) and products of inertia (relative).
const TOLERANCE: f64 = 1e-9;

/// The plane of motion of a planar robot, by an orthonormal basis in the base frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    /// Columns e₁, e₂ (in the plane) and n (its normal, the axis of rotation), in base axes.
    pub basis: Matrix3<f64>,
}

/// The plane of motion, or `None` where the base would leave it.
///
/// Parallel axes alone are not enough: a body with products of inertia about the axis, or mass
/// centres at different heights along it, would tip the base out of the plane.
pub(super) fn detect(base: &Body, joints: &[Joint]) -> Option<Plane> {
    let poses = zero_poses(joints);
    let axes: Vec<Vector3<f64>> = joints
        .iter()
        .zip(&poses)
        .map(|(j, (rotation, _))| rotation * j.axis.as_ref())
        .collect();
    let first = joints.iter().position(|j| j.kind == JointKind::Revolute)?;
    // The first axis, turned so that the base's own axis it is closest to counts positive.
    let normal = axes[first] * axes[first][axes[first].iamax()].signum();
    let basis = basis(&normal);

    let planar_joint = |(joint, axis): (&Joint, &Vector3<f64>)| match joint.kind {
        JointKind::Revolute => axis.cross(&normal).norm() < TOLERANCE,
        JointKind::Prismatic => axis.dot(&normal).abs() < TOLERANCE,
    };
    let height = normal.dot(base.inertia.center());
    let planar_body = |inertia: Inertia| {
        let products = basis.transpose() * inertia.rotational() * normal;
        let scale = inertia.rotational().amax();
        products.xy().amax() < TOLERANCE * scale
            && (normal.dot(inertia.center()) - height).abs() < TOLERANCE
    };
    let planar = joints.iter().zip(&axes).all(planar_joint)
        && planar_body(base.inertia.clone())
        && joints
            .iter()
            .zip(&poses)
            .all(|(joint, (rotation, origin))| {
                planar_body(joint.body.inertia.placed(rotation, origin))
            });
    planar.then_some(Plane { basis })
}

/// Rotation and origin of every body frame in the base frame with all joints at zero.
pub(super) fn zero_poses(joints: &[Joint]) -> Vec<(Matrix3<f64>, Vector3<f64>)> {
    let mut poses: Vec<(Matrix3<f64>, Vector3<f64>)> = Vec::with_capacity(joints.len());
    for joint in joints {
        let (rotation, origin) = match joint.parent {
            Some(parent) => poses[parent],
            None => (Matrix3::identity(), Vector3::zeros()),
        };
        poses.push((
            rotation * joint.placement.rotation,
            origin + rotation * joint.placement.translation,
        ));
    }
    poses
}

/// e₁, e₂, n right-handed; for n = z these are x, y, z.
fn basis(normal: &Vector3<f64>) -> Matrix3<f64> {
    let start = if normal.x.abs() < 0.9 {
        Vector3::x()
    } else {
        Vector3::y()
    };
    let e1 = (start - normal * start.dot(normal)).normalize();
    Matrix3::from_columns(&[e1, normal.cross(&e1), *normal])
}
