//! The base attitude in space.

use super::{Attitude, roll_pitch_yaw};
use crate::autodiff::Scalar;
use crate::dynamics::space::{Space, Spatial, Vector};
use nalgebra::Vector3;

/// How the base attitude is described in space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SpatialAttitude {
    /// Roll φ, pitch ψ, yaw χ with R = Rz(χ)·Ry(ψ)·Rx(φ), as URDF. Singular at ψ = ±π/2.
    #[default]
    RollPitchYaw,
}

impl Attitude<Spatial> for SpatialAttitude {
    const BY_ANGLES: Self = Self::RollPitchYaw;

    fn names(self) -> &'static [&'static str] {
        match self {
            Self::RollPitchYaw => roll_pitch_yaw::NAMES,
        }
    }

    fn start(self) -> &'static [f64] {
        match self {
            Self::RollPitchYaw => roll_pitch_yaw::START,
        }
    }

    #[inline]
    fn rates<S: Scalar>(self, eta: &[S], omega: &Vector3<S>, rates: &mut [S]) {
        match self {
            Self::RollPitchYaw => roll_pitch_yaw::rates(eta, omega, rates),
        }
    }

    #[inline]
    fn to_inertial<S: Scalar>(self, eta: &[S], v: &Vector3<S>) -> Vector3<S> {
        match self {
            Self::RollPitchYaw => roll_pitch_yaw::to_inertial(eta, v),
        }
    }

    #[inline]
    fn to_base<S: Scalar>(self, eta: &[S], v: &Vector3<f64>) -> Vector3<S> {
        // A row of Rᵀv is the inner product of v with a base axis in inertial axes.
        let axes = self.orient(eta, &Spatial::aligned());
        let v = v.map(S::constant);
        Vector3::from_fn(|i, _| Vector::dot(&axes[i], &v))
    }

    #[inline]
    fn orient<S: Scalar>(self, eta: &[S], orientation: &[Vector3<S>; 3]) -> [Vector3<S>; 3] {
        orientation.map(|axis| self.to_inertial(eta, &axis))
    }
}
