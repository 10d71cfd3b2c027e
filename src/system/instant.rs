//! What rows and cost terms are functions of: the pose of base and arm, and the motion at an
//! instant of the path.

use super::plant::Plant;
use crate::autodiff::Scalar;
use crate::dynamics::Data;
use crate::dynamics::space::Space;

/// The pose of base and arm.
#[derive(Debug)]
pub(crate) struct Pose<'a, Sp: Space, S: Scalar> {
    pub plant: &'a Plant<Sp>,
    /// Parameters of the base attitude.
    pub eta: &'a [S],
    /// Seconds after t₀.
    pub t: S,
    /// With the kinematics of the joint positions, and the mass centre.
    pub data: &'a Data<Sp, S>,
    /// Static parameters: the peaks that the cost is about.
    pub parameters: &'a [S],
}

/// The motion at an instant of the path.
#[derive(Debug)]
pub(crate) struct Instant<'a, Sp: Space, S: Scalar> {
    pub pose: Pose<'a, Sp, S>,
    /// Joint rates.
    pub dtheta: &'a [S],
    /// Controls u = H⁻¹τ.
    pub u: &'a [S],
    /// Rates of the base that limits and costs are about, rad/s.
    pub base_rate: &'a [S],
    /// Joint torques τ = Hu; only where a row or a cost term needs them.
    pub torque: &'a [S],
}

/// What rows and cost terms need beyond the state itself.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Needs {
    /// The joint torques.
    pub torque: bool,
    /// φ², the square of the base's rotation angle.
    pub rotation: bool,
    /// The kinematics at t_f, for rows and terms of the end.
    pub end_pose: bool,
}

impl Needs {
    /// What either needs.
    pub fn and(self, other: Self) -> Self {
        Self {
            torque: self.torque || other.torque,
            rotation: self.rotation || other.rotation,
            end_pose: self.end_pose || other.end_pose,
        }
    }
}
