//! What every description of the base's orientation provides.

use super::SpatialAttitude;
use crate::autodiff::Scalar;
use crate::dynamics::algebra::{Algebra, Vector};
use std::fmt::Debug;

/// A description of the base's orientation by parameters η, which are states of the problem.
///
/// A small value rather than a type of its own for each description: everything above is compiled
/// once for the plane and once for space.
pub trait Attitude<Sp: Algebra>: Copy + Debug + PartialEq + Send + Sync + 'static {
    /// The description by angles, in which orientations are given: the heading in the plane,
    /// roll-pitch-yaw in space.
    const BY_ANGLES: Self;

    /// Which of the descriptions in space this is; `None` in the plane.
    fn in_space(self) -> Option<SpatialAttitude>;

    /// Names of the parameters.
    fn names(self) -> &'static [&'static str];

    /// Number of parameters.
    #[inline(always)]
    fn count(self) -> usize {
        self.names().len()
    }

    /// Parameters of the orientation in which base axes and inertial axes agree, as they do at t₀
    /// unless the base starts turned.
    fn start(self) -> &'static [f64];

    /// Parameters of the orientation that these angles give: the heading in the plane, else roll,
    /// pitch, yaw, rad.
    fn of_angles(self, angles: &[f64]) -> Vec<f64>;

    /// Whether the parameters are angles, each with limits and a cost of its own. Else these are
    /// about the rotation angle out of the inertial axes, and about the angular velocity.
    fn is_angles(self) -> bool;

    /// η̇ (length [`Attitude::count`]) for the base's angular velocity in base axes (rad/s).
    fn rates<S: Scalar>(self, eta: &[S], omega: &Sp::Angular<S>, rates: &mut [S]);

    /// A vector in base axes, rotated to inertial axes.
    fn to_inertial<S: Scalar>(self, eta: &[S], v: &Sp::Linear<S>) -> Sp::Linear<S>;

    /// A constant angular vector in inertial axes, rotated to base axes.
    fn to_base<S: Scalar>(self, eta: &[S], v: &Sp::Angular<f64>) -> Sp::Angular<S>;

    /// An orientation in base axes, rotated to inertial axes.
    fn orient<S: Scalar>(self, eta: &[S], orientation: &Sp::Orientation<S>) -> Sp::Orientation<S>;

    /// φ², the square of the angle of the shortest rotation out of the inertial axes; smooth at
    /// zero, where φ is not.
    fn squared_rotation_angle<S: Scalar>(self, eta: &[S]) -> S;

    /// The constant orientation that `eta` describes.
    fn orientation(self, eta: &[f64]) -> Sp::Orientation<f64> {
        self.orient(eta, &Sp::aligned())
    }

    /// The base position ζ = −R(η)·r_cm relative to the system's mass centre (Remark 1), m.
    #[inline]
    fn base_position<S: Scalar>(self, eta: &[S], system_center: &Sp::Linear<S>) -> Sp::Linear<S> {
        self.to_inertial(eta, &system_center.times(-1.0))
    }
}
