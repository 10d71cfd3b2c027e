//! Finds out whether all motion of a robot stays in one plane.
//!
//! Derived in docs/algorithms.md#planar-motion.

use super::{Body, Inertia, Joint, JointKind, Placement};
use nalgebra::{Matrix3, Vector3};

/// Rounding allowed for in directions, heights (m) and products of inertia (relative).
const TOLERANCE: f64 = 1e-9;

/// The plane of motion of a planar robot, by an orthonormal basis in the base frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    /// Columns e₁, e₂ (in the plane) and n (its normal, the axis of rotation), in base axes.
    pub basis: Matrix3<f64>,
}

/// By how much a robot misses planar motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// Largest angle between a turning axis and the normal, or a sliding axis and the plane, rad.
    pub tilt: f64,
    /// Largest distance of a mass centre from the plane of the base's, m.
    pub height: f64,
    /// Largest product of inertia about the normal, relative to the body's largest moment.
    pub product: f64,
}

impl Deviation {
    /// Whether none of the three exceeds `tolerance` (rad, m, relative).
    pub fn within(&self, tolerance: f64) -> bool {
        self.tilt < tolerance && self.height < tolerance && self.product < tolerance
    }
}

/// The plane of motion, or `None` where the base would leave it.
///
/// Parallel axes alone are not enough: a body with products of inertia about the axis, or mass
/// centres at different heights along it, would tip the base out of the plane.
pub(super) fn detect(base: &Body, joints: &[Joint]) -> Option<Plane> {
    let (plane, deviation) = measure(base, joints)?;
    deviation.within(TOLERANCE).then_some(plane)
}

/// The plane across the first turning axis and how far the robot is from moving in it; `None`
/// where no joint turns.
pub(super) fn measure(base: &Body, joints: &[Joint]) -> Option<(Plane, Deviation)> {
    let poses = zero_poses(joints);
    let axes: Vec<Vector3<f64>> = joints
        .iter()
        .zip(&poses)
        .map(|(joint, pose)| pose.rotation * joint.axis.as_ref())
        .collect();
    let first = joints.iter().position(|j| j.kind == JointKind::Revolute)?;
    // The first axis, turned so that the base's own axis it is closest to counts positive.
    let normal = axes[first] * axes[first][axes[first].iamax()].signum();
    let basis = basis(&normal);

    let height = normal.dot(base.inertia.center());
    let mut deviation = Deviation {
        tilt: 0.0,
        height: 0.0,
        product: 0.0,
    };
    for (joint, axis) in joints.iter().zip(&axes) {
        let sine = match joint.kind {
            JointKind::Revolute => axis.cross(&normal).norm(),
            JointKind::Prismatic => axis.dot(&normal).abs(),
        };
        deviation.tilt = deviation.tilt.max(sine.min(1.0).asin());
    }
    let mut add = |inertia: &Inertia| {
        if inertia.mass() == 0.0 {
            return;
        }
        let products = basis.transpose() * inertia.rotational() * normal;
        let scale = inertia.rotational().amax();
        if scale > 0.0 {
            deviation.product = deviation.product.max(products.xy().amax() / scale);
        }
        let off = (normal.dot(inertia.center()) - height).abs();
        deviation.height = deviation.height.max(off);
    };
    add(&base.inertia);
    for (joint, pose) in joints.iter().zip(&poses) {
        add(&joint.body.inertia.placed(&pose.rotation, &pose.translation));
    }
    Some((Plane { basis }, deviation))
}

/// Pose of every body frame in the base frame with all joints at zero.
pub(super) fn zero_poses(joints: &[Joint]) -> Vec<Placement> {
    let mut poses: Vec<Placement> = Vec::with_capacity(joints.len());
    for joint in joints {
        poses.push(match joint.parent {
            Some(parent) => poses[parent].then(&joint.placement),
            None => joint.placement.clone(),
        });
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
