//! The planned motion over time, and its figures.

use crate::dynamics::attitude::SpatialAttitude;

/// The planned motion, one row a time; rows are as long as the quantity has components.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct Trajectory {
    /// Times, s; the last is t_f.
    pub t: Vec<f64>,
    /// How `base_attitude` describes the orientation; `None` for the one angle of the plane.
    pub attitude: Option<SpatialAttitude>,
    /// Base attitude η: angles in rad, or the parameters of another description.
    pub base_attitude: Vec<Vec<f64>>,
    /// Base position ζ relative to the system's mass centre, inertial axes, m.
    pub base_position: Vec<Vec<f64>>,
    /// Rates η̇ of angles, or else the angular velocity in base axes, rad/s.
    pub base_rate: Vec<Vec<f64>>,
    /// Joint positions θ, rad or m.
    pub joint_position: Vec<Vec<f64>>,
    /// Joint rates θ̇, rad/s or m/s.
    pub joint_velocity: Vec<Vec<f64>>,
    /// Controls u = H⁻¹τ, rad/s² or m/s².
    pub control: Vec<Vec<f64>>,
    /// Joint torques τ = Hu, N·m or N.
    pub joint_torque: Vec<Vec<f64>>,
}

/// Figures a person asks for first.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct Metrics {
    /// Largest base angle, rad: of the rotation out of the axes the attitude is counted from.
    pub max_base_attitude: f64,
    /// The same at t_f, rad.
    pub final_base_attitude: f64,
    /// Largest distance of the base from where it started, m.
    pub max_base_displacement: f64,
    /// Distance at t_f, m.
    pub final_base_displacement: f64,
    /// Largest magnitude of any joint rate, rad/s or m/s.
    pub peak_joint_velocity: f64,
    /// Largest magnitude of any joint torque, N·m or N.
    pub peak_joint_torque: f64,
}
