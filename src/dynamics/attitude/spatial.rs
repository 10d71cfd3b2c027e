//! The base attitude in space, by one of three descriptions.

use super::{Attitude, SpatialAttitude, quaternion, rodrigues, roll_pitch_yaw, rotation_angle};
use crate::autodiff::Scalar;
use crate::dynamics::algebra::{Algebra, Spatial, Vector};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use std::f64::consts::{PI, TAU};

impl SpatialAttitude {
    /// The orientation that `eta` describes.
    pub fn to_quaternion(self, eta: &[f64]) -> UnitQuaternion<f64> {
        match self {
            Self::RollPitchYaw => UnitQuaternion::from_euler_angles(eta[0], eta[1], eta[2]),
            Self::Quaternion => {
                UnitQuaternion::new_normalize(Quaternion::new(eta[0], eta[1], eta[2], eta[3]))
            }
            Self::Mrp => {
                let sigma = rodrigues::vector(eta);
                let square = sigma.norm_squared();
                UnitQuaternion::new_normalize(Quaternion::from_parts(1.0 - square, 2.0 * sigma))
            }
        }
    }

    /// The parameters of `orientation`; of all that describe it those nearest to `near`, which
    /// belong to the instant before.
    pub fn of_quaternion(self, orientation: &UnitQuaternion<f64>, near: &[f64]) -> Vec<f64> {
        let candidates: Vec<Vec<f64>> = match self {
            Self::RollPitchYaw => {
                let (roll, pitch, yaw) = orientation.euler_angles();
                let whole = |angle: f64, near: f64| angle + TAU * ((near - angle) / TAU).round();
                [[roll, pitch, yaw], [roll + PI, PI - pitch, yaw + PI]]
                    .iter()
                    .map(|angles| {
                        angles
                            .iter()
                            .zip(near)
                            .map(|(a, n)| whole(*a, *n))
                            .collect()
                    })
                    .collect()
            }
            Self::Quaternion => [1.0, -1.0]
                .iter()
                .map(|sign| {
                    let q = orientation.quaternion() * *sign;
                    vec![q.w, q.i, q.j, q.k]
                })
                .collect(),
            Self::Mrp => [1.0, -1.0]
                .iter()
                .map(|sign| orientation.quaternion() * *sign)
                .filter(|q| q.w > -1.0)
                .map(|q| (q.imag() / (1.0 + q.w)).iter().copied().collect())
                .collect(),
        };
        let distance = |candidate: &Vec<f64>| -> f64 {
            let pairs = candidate.iter().zip(near);
            pairs.map(|(a, b)| (a - b).powi(2)).sum()
        };
        candidates
            .into_iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .unwrap_or_default()
    }
}

impl Attitude<Spatial> for SpatialAttitude {
    const BY_ANGLES: Self = Self::RollPitchYaw;

    fn in_space(self) -> Option<Self> {
        Some(self)
    }

    fn names(self) -> &'static [&'static str] {
        match self {
            Self::RollPitchYaw => roll_pitch_yaw::NAMES,
            Self::Quaternion => quaternion::NAMES,
            Self::Mrp => rodrigues::NAMES,
        }
    }

    fn start(self) -> &'static [f64] {
        match self {
            Self::RollPitchYaw => roll_pitch_yaw::START,
            Self::Quaternion => quaternion::START,
            Self::Mrp => rodrigues::START,
        }
    }

    fn of_angles(self, angles: &[f64]) -> Vec<f64> {
        match self {
            Self::RollPitchYaw => angles.to_vec(),
            // To the last bit, as where nothing is said.
            _ if angles.iter().all(|angle| *angle == 0.0) => self.start().to_vec(),
            _ => {
                let orientation = Self::RollPitchYaw.to_quaternion(angles);
                self.of_quaternion(&orientation, self.start())
            }
        }
    }

    fn is_angles(self) -> bool {
        self == Self::RollPitchYaw
    }

    #[inline]
    fn rates<S: Scalar>(self, eta: &[S], omega: &Vector3<S>, rates: &mut [S]) {
        match self {
            Self::RollPitchYaw => roll_pitch_yaw::rates(eta, omega, rates),
            Self::Quaternion => quaternion::rates(eta, omega, rates),
            Self::Mrp => rodrigues::rates(eta, omega, rates),
        }
    }

    #[inline]
    fn to_inertial<S: Scalar>(self, eta: &[S], v: &Vector3<S>) -> Vector3<S> {
        match self {
            Self::RollPitchYaw => roll_pitch_yaw::to_inertial(eta, v),
            Self::Quaternion => quaternion::to_inertial(eta, v),
            Self::Mrp => rodrigues::to_inertial(eta, v),
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

    #[inline]
    fn squared_rotation_angle<S: Scalar>(self, eta: &[S]) -> S {
        match self {
            Self::RollPitchYaw => {
                let (w, v) = roll_pitch_yaw::quaternion(eta);
                rotation_angle::squared_by_quaternion(w, &v)
            }
            Self::Quaternion => {
                rotation_angle::squared_by_quaternion(eta[0], &quaternion::vector(eta))
            }
            Self::Mrp => rodrigues::squared_rotation_angle(eta),
        }
    }
}
