//! Vectors and orientations as they stand in the integrated state.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// Three numbers of the state.
pub(super) fn vector(y: &[f64], start: usize) -> Vector3<f64> {
    Vector3::new(y[start], y[start + 1], y[start + 2])
}

/// A quaternion w, x, y, z, whose length may have drifted.
pub(super) fn unit(y: &[f64]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(y[0], y[1], y[2], y[3]))
}

/// Writes w, x, y, z.
pub(super) fn write(orientation: &UnitQuaternion<f64>, y: &mut [f64]) {
    let q = orientation.quaternion();
    y[..4].copy_from_slice(&[q.w, q.i, q.j, q.k]);
}

/// q̇ = ½ωq for an angular velocity in inertial axes.
pub(super) fn turn_rate(omega: &Vector3<f64>, y: &[f64], dy: &mut [f64]) {
    let q = Quaternion::new(y[0], y[1], y[2], y[3]);
    let rate = Quaternion::from_imag(*omega) * q * 0.5;
    dy[..4].copy_from_slice(&[rate.w, rate.i, rate.j, rate.k]);
}
