//! The base attitude in the plane: one angle.

use super::{Attitude, SpatialAttitude};
use crate::autodiff::Scalar;
use crate::dynamics::algebra::Planar;
use nalgebra::{Vector1, Vector2};

/// The angle from inertial to base axes, rad.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlanarAngle;

impl Attitude<Planar> for PlanarAngle {
    const BY_ANGLES: Self = Self;

    fn in_space(self) -> Option<SpatialAttitude> {
        None
    }

    #[inline(always)]
    fn names(self) -> &'static [&'static str] {
        &["base attitude"]
    }

    fn start(self) -> &'static [f64] {
        &[0.0]
    }

    fn of_angles(self, angles: &[f64]) -> Vec<f64> {
        angles.to_vec()
    }

    fn is_angles(self) -> bool {
        true
    }

    #[inline]
    fn rates<S: Scalar>(self, _eta: &[S], omega: &Vector1<S>, rates: &mut [S]) {
        rates[0] = omega.x;
    }

    #[inline]
    fn to_inertial<S: Scalar>(self, eta: &[S], v: &Vector2<S>) -> Vector2<S> {
        let (s, c) = eta[0].sin_cos();
        Vector2::new(c * v.x - s * v.y, s * v.x + c * v.y)
    }

    #[inline]
    fn to_base<S: Scalar>(self, _eta: &[S], v: &Vector1<f64>) -> Vector1<S> {
        v.map(S::constant)
    }

    #[inline]
    fn squared_rotation_angle<S: Scalar>(self, eta: &[S]) -> S {
        eta[0].square()
    }

    #[inline]
    fn orient<S: Scalar>(self, eta: &[S], orientation: &Vector2<S>) -> Vector2<S> {
        self.to_inertial(eta, orientation)
    }
}
