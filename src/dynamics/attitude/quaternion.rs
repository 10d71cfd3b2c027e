//! Unit quaternion w, x, y, z, scalar first, Hamilton's product: R·v = v + 2w(u×v) + 2u×(u×v) with
//! u = (x, y, z), and q̇ = ½q∘(0, ω). Nowhere singular; q and −q are the same orientation.
//! M. D. Shuster, A Survey of Attitude Representations, J. Astronaut. Sci. 41(4), 1993, 439–517.
//!
//! The kinematics keep the length of q, so that no row has to: along a plan it departs from one
//! by no more than the plan's own error.

use crate::autodiff::Scalar;
use crate::dynamics::algebra::{Algebra, Spatial, Vector};
use nalgebra::Vector3;

pub(super) const NAMES: &[&str] = &["base q_w", "base q_x", "base q_y", "base q_z"];
pub(super) const START: &[f64] = &[1.0, 0.0, 0.0, 0.0];

/// The vector part.
#[inline]
pub(super) fn vector<S: Scalar>(eta: &[S]) -> Vector3<S> {
    Vector3::new(eta[1], eta[2], eta[3])
}

#[inline]
pub(super) fn rates<S: Scalar>(eta: &[S], omega: &Vector3<S>, rates: &mut [S]) {
    let u = vector(eta);
    let half = omega.times(0.5);
    rates[0] = -Vector::dot(&u, &half);
    let rate = half.scaled(eta[0]) + Spatial::cross_angular(&u, &half);
    rates[1..4].copy_from_slice(rate.components());
}

#[inline]
pub(super) fn to_inertial<S: Scalar>(eta: &[S], v: &Vector3<S>) -> Vector3<S> {
    let u = vector(eta);
    let across = Spatial::cross(&u, v).times(2.0);
    *v + across.scaled(eta[0]) + Spatial::cross(&u, &across)
}
