//! A motion at chosen instants, for other tools.

use super::base::base_samples;
use super::{ExportError, Times};
use crate::dynamics::JointKind;
use crate::problem::Problem;
use crate::system::{at_fractions, joint_accelerations};
use crate::transcription::Discretization;

pub use super::base::BaseSample;

/// A motion at instants that rise; a row a time, joints in the robot's order.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Samples {
    /// Names of the joints.
    pub joints: Vec<String>,
    /// What each joint does.
    pub kinds: Vec<JointKind>,
    /// Times, s.
    pub t: Vec<f64>,
    /// The base.
    pub base: Vec<BaseSample>,
    /// Joint positions, rad or m.
    pub joint_position: Vec<Vec<f64>>,
    /// Joint rates, rad/s or m/s.
    pub joint_velocity: Vec<Vec<f64>>,
    /// Joint accelerations, rad/s² or m/s².
    pub joint_acceleration: Vec<Vec<f64>>,
    /// Controls u = H⁻¹τ, rad/s² or m/s².
    pub control: Vec<Vec<f64>>,
    /// Joint torques, N·m or N.
    pub joint_torque: Vec<Vec<f64>>,
}

impl Samples {
    /// The motion of a plan for `problem`, from the polynomials of its states and controls.
    ///
    /// # Errors
    /// [`ExportError`] for a rate that cannot be and a motion that is not finite.
    pub fn of(problem: &Problem, plan: &Discretization, times: Times) -> Result<Self, ExportError> {
        let motion = at_fractions(problem, plan, &times.fractions(plan)?);
        let joints = problem.robot.joints().iter();
        let (joints, kinds) = joints.map(|joint| (joint.name.clone(), joint.kind)).unzip();
        let samples = Self {
            joints,
            kinds,
            base: base_samples(problem, &motion),
            joint_acceleration: joint_accelerations(problem, plan, &motion),
            t: motion.t,
            joint_position: motion.joint_position,
            joint_velocity: motion.joint_velocity,
            control: motion.control,
            joint_torque: motion.joint_torque,
        };
        match (0..samples.t.len()).find(|&k| !samples.is_finite(k)) {
            Some(k) => Err(ExportError::NotFinite { t: samples.t[k] }),
            None => Ok(samples),
        }
    }

    /// The motion at the joints and the time each belongs to: position, rate, acceleration, control, torque.
    pub(super) fn joint_rows(&self) -> [&[Vec<f64>]; 5] {
        [
            &self.joint_position,
            &self.joint_velocity,
            &self.joint_acceleration,
            &self.control,
            &self.joint_torque,
        ]
    }

    fn is_finite(&self, k: usize) -> bool {
        let base = &self.base[k];
        let of_base = [&base.position, &base.velocity, &base.angular_velocity];
        self.t[k].is_finite()
            && base.quaternion.iter().all(|value| value.is_finite())
            && of_base.into_iter().flatten().all(|value| value.is_finite())
            && self
                .joint_rows()
                .iter()
                .all(|rows| rows[k].iter().all(|value| value.is_finite()))
    }
}
