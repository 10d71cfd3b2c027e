//! What joints and base spend, all components alike, whatever the weights of a problem.

use crate::collocation::Mesh;
use crate::system::Trajectory;

/// What the joints spend, all joints alike.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct JointEffort {
    /// ∫‖u‖² dt, rad²/s³ (m² for sliding joints).
    pub control: f64,
    /// ∫‖τ‖² dt, N²m²s (N² for sliding joints).
    pub torque: f64,
    /// ∫‖η̇‖² dt of the base, rad²/s.
    pub base_rate: f64,
    /// ∫‖θ̇‖² dt, rad²/s.
    pub joint_rate: f64,
}

impl JointEffort {
    /// The integrals over a motion on `mesh`, by the quadrature of (25).
    pub fn of(trajectory: &Trajectory, mesh: &Mesh) -> Self {
        let duration = trajectory.t.last().copied().unwrap_or(0.0);
        let weights = quadrature(mesh, duration);
        let integral = |rows: &[Vec<f64>]| -> f64 {
            let square = |row: &Vec<f64>| -> f64 { row.iter().map(|v| v * v).sum() };
            weights
                .iter()
                .zip(rows)
                .map(|(w, row)| w * square(row))
                .sum()
        };
        Self {
            control: integral(&trajectory.control),
            torque: integral(&trajectory.joint_torque),
            base_rate: integral(&trajectory.base_rate),
            joint_rate: integral(&trajectory.joint_velocity),
        }
    }
}

/// Quadrature weights in seconds, one a collocation point.
pub(crate) fn quadrature(mesh: &Mesh, duration: f64) -> Vec<f64> {
    (0..mesh.segments())
        .flat_map(|s| {
            let half = 0.5 * mesh.width(s) * duration;
            mesh.rule(s).weights().iter().map(move |w| half * w)
        })
        .collect()
}
