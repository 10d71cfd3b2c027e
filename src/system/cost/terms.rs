//! The cost (14) of a planned motion, term by term.

use crate::collocation::Mesh;
use crate::problem::Problem;
use crate::system::{Trajectory, turned};

/// The terms of (14), each with its weight, by the quadrature of (25). Their sum is J.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CostTerms {
    /// ‖η(t_f)‖².
    pub final_base_attitude: f64,
    /// ‖ζ(t_f) − ζ(t₀)‖².
    pub final_base_position: f64,
    /// ∫‖η̇‖² dt.
    pub base_rate: f64,
    /// ∫‖θ̇‖² dt.
    pub joint_rate: f64,
    /// ∫‖u‖² dt.
    pub control: f64,
    /// ∫‖τ‖² dt.
    pub torque: f64,
    /// The duration's.
    pub duration: f64,
    /// ∫[η̇, θ̇]ᵀΛ[η̇, θ̇] dt by its three blocks: base alone, joints alone, and what couples them.
    pub rate_matrix: [f64; 3],
}

impl CostTerms {
    /// The terms of a motion on `mesh` with the weights of `problem`.
    pub fn of(problem: &Problem, trajectory: &Trajectory, mesh: &Mesh) -> Self {
        let cost = &problem.cost;
        let duration = trajectory.t.last().copied().unwrap_or(0.0);
        let weights = quadrature(mesh, duration);
        let integral = |weight: &[f64], rows: &[Vec<f64>]| -> f64 {
            let square = |row: &Vec<f64>| -> f64 { squares(weight, row) };
            weights
                .iter()
                .zip(rows)
                .map(|(w, row)| w * square(row))
                .sum()
        };
        let ends = |rows: &[Vec<f64>]| match (rows.first(), rows.last()) {
            (Some(first), Some(last)) => last.iter().zip(first).map(|(a, b)| a - b).collect(),
            _ => Vec::new(),
        };
        let turned = turned(trajectory);
        let last = turned.last();
        Self {
            final_base_attitude: last.map_or(0.0, |eta| squares(&cost.final_base_attitude, eta)),
            final_base_position: squares(
                &cost.final_base_position,
                &ends(&trajectory.base_position),
            ),
            base_rate: integral(&cost.base_rate, &trajectory.base_rate),
            joint_rate: integral(&cost.joint_rate, &trajectory.joint_velocity),
            control: integral(&cost.control, &trajectory.control),
            torque: integral(&cost.torque, &trajectory.joint_torque),
            duration: cost.duration * duration,
            rate_matrix: match &cost.rate_matrix {
                Some(matrix) => blocks(matrix, trajectory, &weights),
                None => [0.0; 3],
            },
        }
    }

    /// J.
    pub fn total(&self) -> f64 {
        self.base() + self.joints() + self.duration + self.rate_matrix[2]
    }

    /// What is about the base's motion alone.
    pub fn base(&self) -> f64 {
        self.final_base_attitude + self.final_base_position + self.base_rate + self.rate_matrix[0]
    }

    /// What is about the joints' motion and effort alone.
    pub fn joints(&self) -> f64 {
        self.joint_rate + self.control + self.torque + self.rate_matrix[1]
    }
}

/// What the joints spend, all joints alike.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
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
fn quadrature(mesh: &Mesh, duration: f64) -> Vec<f64> {
    (0..mesh.segments())
        .flat_map(|s| {
            let half = 0.5 * mesh.width(s) * duration;
            mesh.rule(s).weights().iter().map(move |w| half * w)
        })
        .collect()
}

fn squares(weights: &[f64], values: &[f64]) -> f64 {
    weights.iter().zip(values).map(|(w, v)| w * v * v).sum()
}

fn blocks(matrix: &[Vec<f64>], trajectory: &Trajectory, weights: &[f64]) -> [f64; 3] {
    let mut sums = [0.0; 3];
    let rows = trajectory.base_rate.iter().zip(&trajectory.joint_velocity);
    for (weight, (base, joints)) in weights.iter().zip(rows) {
        let rates: Vec<f64> = base.iter().chain(joints).copied().collect();
        for (i, row) in matrix.iter().enumerate() {
            for (j, lambda) in row.iter().enumerate() {
                let block = match (i < base.len(), j < base.len()) {
                    (true, true) => 0,
                    (false, false) => 1,
                    _ => 2,
                };
                sums[block] += weight * lambda * rates[i] * rates[j];
            }
        }
    }
    sums
}
