//! Roll φ, pitch ψ, yaw χ with R = Rz(χ)·Ry(ψ)·Rx(φ), as URDF. Singular at ψ = ±π/2.

use crate::autodiff::Scalar;
use nalgebra::Vector3;

pub(super) const NAMES: &[&str] = &["base roll", "base pitch", "base yaw"];
pub(super) const START: &[f64] = &[0.0; 3];

#[inline]
pub(super) fn rates<S: Scalar>(eta: &[S], omega: &Vector3<S>, rates: &mut [S]) {
    let (sin_roll, cos_roll) = eta[0].sin_cos();
    let (sin_pitch, cos_pitch) = eta[1].sin_cos();
    let level = sin_roll * omega.y + cos_roll * omega.z;
    let yaw = level / cos_pitch;
    rates[0] = omega.x + sin_pitch * yaw;
    rates[1] = cos_roll * omega.y - sin_roll * omega.z;
    rates[2] = yaw;
}

#[inline]
pub(super) fn to_inertial<S: Scalar>(eta: &[S], v: &Vector3<S>) -> Vector3<S> {
    let turn = |angle: S, a: S, b: S| {
        let (s, c) = angle.sin_cos();
        (c * a - s * b, s * a + c * b)
    };
    let (y, z) = turn(eta[0], v.y, v.z);
    let (z, x) = turn(eta[1], z, v.x);
    let (x, y) = turn(eta[2], x, y);
    Vector3::new(x, y, z)
}

/// Scalar and vector part of the quaternion of the same orientation.
#[inline]
pub(super) fn quaternion<S: Scalar>(eta: &[S]) -> (S, Vector3<S>) {
    let [(sr, cr), (sp, cp), (sy, cy)] = [0, 1, 2].map(|i| (eta[i] * 0.5).sin_cos());
    let vector = Vector3::new(
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
    );
    (cr * cp * cy + sr * sp * sy, vector)
}
