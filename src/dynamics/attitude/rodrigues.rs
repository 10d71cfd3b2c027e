//! Modified Rodrigues parameters σ = tan(φ/4)·(axis): R·v = v + [4(1 − σ²)(σ×v) + 8σ×(σ×v)]/(1 + σ²)²
//! and σ̇ = ¼[(1 − σ²)ω + 2σ×ω + 2(σ·ω)σ]. Singular at a full turn, where σ is infinite.
//! H. Schaub, J. L. Junkins, Stereographic Orientation Parameters for Attitude Dynamics, J. Astronaut.
//! Sci. 44(1), 1996, 1–19.

use crate::autodiff::Scalar;
use crate::dynamics::algebra::{Algebra, Spatial, Vector};
use nalgebra::Vector3;

pub(super) const NAMES: &[&str] = &["base mrp x", "base mrp y", "base mrp z"];
pub(super) const START: &[f64] = &[0.0; 3];

#[inline]
pub(super) fn vector<S: Scalar>(eta: &[S]) -> Vector3<S> {
    Vector3::new(eta[0], eta[1], eta[2])
}

#[inline]
pub(super) fn rates<S: Scalar>(eta: &[S], omega: &Vector3<S>, rates: &mut [S]) {
    let sigma = vector(eta);
    let half = omega.times(0.5);
    let along = Vector::dot(&sigma, &half);
    let short = -Vector::dot(&sigma, &sigma) + 1.0;
    let rate =
        half.scaled(short).times(0.5) + Spatial::cross_angular(&sigma, &half) + sigma.scaled(along);
    rates[..3].copy_from_slice(rate.components());
}

#[inline]
pub(super) fn to_inertial<S: Scalar>(eta: &[S], v: &Vector3<S>) -> Vector3<S> {
    // As by the quaternion (1 − σ², 2σ)/(1 + σ²).
    let sigma = vector(eta);
    let square = Vector::dot(&sigma, &sigma);
    let part = (square + 1.0).recip();
    let u = sigma.scaled(part * 2.0);
    let w = (-square + 1.0) * part;
    let across = Spatial::cross(&u, v).times(2.0);
    *v + across.scaled(w) + Spatial::cross(&u, &across)
}

/// φ² of the shortest rotation, 0 to π²; beyond half a turn the shadow −σ/σ² is the shorter way.
#[inline]
pub(super) fn squared_rotation_angle<S: Scalar>(eta: &[S]) -> S {
    let sigma = vector(eta);
    let square = Vector::dot(&sigma, &sigma);
    super::rotation_angle::squared(if square.value() > 1.0 {
        square.recip()
    } else {
        square
    })
}
