//! Where one frame stands in another.

use nalgebra::{Matrix3, Rotation3, Vector3};

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
