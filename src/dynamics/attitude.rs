//! The attitude of the base: one angle in the plane, roll-pitch-yaw in space.

use super::space::{Planar, Space, Spatial, Vector};
use crate::autodiff::Scalar;
use nalgebra::{Vector1, Vector2, Vector3};

/// How attitude angles η describe the base's orientation.
pub trait Attitude: Space {
    /// Names of the angles.
    const NAMES: &'static [&'static str];

    /// η̇ (length [`Space::ANGLES`], rad/s) for the base's angular velocity in base axes (rad/s).
    fn rates<S: Scalar>(eta: &[S], omega: &Self::Angular<S>, rates: &mut [S]);

    /// A vector in base axes, turned to inertial axes.
    fn to_inertial<S: Scalar>(eta: &[S], v: &Self::Linear<S>) -> Self::Linear<S>;

    /// A constant angular vector in inertial axes, turned to base axes.
    fn to_base<S: Scalar>(eta: &[S], v: &Self::Angular<f64>) -> Self::Angular<S>;

    /// An orientation in base axes, turned to inertial axes.
    fn orient<S: Scalar>(eta: &[S], orientation: &Self::Orientation<S>) -> Self::Orientation<S>;

    /// The constant orientation that attitude angles (rad) describe.
    fn orientation(eta: &[f64]) -> Self::Orientation<f64> {
        Self::orient(eta, &Self::aligned())
    }
}

impl Attitude for Planar {
    const NAMES: &'static [&'static str] = &["base attitude"];

    #[inline]
    fn rates<S: Scalar>(_eta: &[S], omega: &Vector1<S>, rates: &mut [S]) {
        rates[0] = omega.x;
    }

    #[inline]
    fn to_inertial<S: Scalar>(eta: &[S], v: &Vector2<S>) -> Vector2<S> {
        let (s, c) = eta[0].sin_cos();
        Vector2::new(c * v.x - s * v.y, s * v.x + c * v.y)
    }

    #[inline]
    fn to_base<S: Scalar>(_eta: &[S], v: &Vector1<f64>) -> Vector1<S> {
        v.map(S::constant)
    }

    #[inline]
    fn orient<S: Scalar>(eta: &[S], orientation: &Vector2<S>) -> Vector2<S> {
        Self::to_inertial(eta, orientation)
    }
}

/// Roll φ, pitch ψ, yaw χ with R = Rz(χ)·Ry(ψ)·Rx(φ), as URDF. Singular at ψ = ±π/2.
impl Attitude for Spatial {
    const NAMES: &'static [&'static str] = &["base roll", "base pitch", "base yaw"];

    #[inline]
    fn rates<S: Scalar>(eta: &[S], omega: &Vector3<S>, rates: &mut [S]) {
        let (sin_roll, cos_roll) = eta[0].sin_cos();
        let (sin_pitch, cos_pitch) = eta[1].sin_cos();
        let level = sin_roll * omega.y + cos_roll * omega.z;
        let yaw = level / cos_pitch;
        rates[0] = omega.x + sin_pitch * yaw;
        rates[1] = cos_roll * omega.y - sin_roll * omega.z;
        rates[2] = yaw;
    }

    #[inline]
    fn to_inertial<S: Scalar>(eta: &[S], v: &Vector3<S>) -> Vector3<S> {
        let turn = |angle: S, a: S, b: S| {
            let (s, c) = angle.sin_cos();
            (c * a - s * b, s * a + c * b)
        };
        let (y, z) = turn(eta[0], v.y, v.z);
        let (z, x) = turn(eta[1], z, v.x);
        let (x, y) = turn(eta[2], x, y);
        Vector3::new(x, y, z)
    }

    #[inline]
    fn to_base<S: Scalar>(eta: &[S], v: &Vector3<f64>) -> Vector3<S> {
        // A row of Rᵀv is the inner product of v with a base axis in inertial axes.
        let axes = Self::orient(eta, &Self::aligned());
        let v = v.map(S::constant);
        Vector3::from_fn(|i, _| Vector::dot(&axes[i], &v))
    }

    #[inline]
    fn orient<S: Scalar>(eta: &[S], orientation: &[Vector3<S>; 3]) -> [Vector3<S>; 3] {
        orientation.map(|axis| Self::to_inertial(eta, &axis))
    }
}

/// The base position ζ = −R(η)·r_cm relative to the system's mass centre (Remark 1), m.
#[inline]
pub fn base_position<Sp: Attitude, S: Scalar>(
    eta: &[S],
    system_center: &Sp::Linear<S>,
) -> Sp::Linear<S> {
    Sp::to_inertial(eta, &system_center.times(-1.0))
}
