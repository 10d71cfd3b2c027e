//! What became of a row.

use super::{RowStatus, bits};
use crate::config::Cell;
use crate::planner::Plan;
use crate::system::{GoalError, Trajectory};
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// What became of a row.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Record {
    /// Its position in the batch, counted from 0.
    pub position: u64,
    /// Its key.
    pub key: String,
    /// Name of the problem; empty where there is none.
    pub name: String,
    /// How it ended.
    pub status: RowStatus,
    /// Why it ended so, in one line; empty where it is solved.
    pub reason: String,
    /// What the problem has at the keys that vary, in their order; empty where there is no problem.
    pub cells: Vec<Cell>,
    /// Figures of the plan, where there is one.
    pub figures: Option<Figures>,
    /// The planned motion, where it was asked for.
    pub motion: Option<Motion>,
    /// Wall time of all of it, s.
    #[serde(with = "bits")]
    pub seconds: f64,
}

/// Figures of a plan, SI units and radians.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Figures {
    /// Cost J of (14).
    #[serde(with = "bits")]
    pub objective: f64,
    /// Largest error (28) on the final mesh.
    #[serde(with = "bits")]
    pub max_error: f64,
    /// Collocation points of the final mesh.
    pub points: usize,
    /// Segments of the final mesh.
    pub segments: usize,
    /// Meshes that were solved.
    pub mesh_iterations: usize,
    /// Iterations of the solver on all of them.
    pub nlp_iterations: u64,
    /// Largest base angle along the path, rad.
    #[serde(with = "bits")]
    pub max_base_attitude: f64,
    /// The same at t_f, rad.
    #[serde(with = "bits")]
    pub final_base_attitude: f64,
    /// Largest distance of the base from where it started, m.
    #[serde(with = "bits")]
    pub max_base_displacement: f64,
    /// The same at t_f, m.
    #[serde(with = "bits")]
    pub final_base_displacement: f64,
    /// Largest magnitude of any joint rate, rad/s or m/s.
    #[serde(with = "bits")]
    pub peak_joint_velocity: f64,
    /// Largest magnitude of any joint torque, N·m or N.
    #[serde(with = "bits")]
    pub peak_joint_torque: f64,
    /// Largest distance from a goal of the end effector, m; `None` without such a goal.
    #[serde(with = "bits")]
    pub goal_distance: Option<f64>,
    /// Largest angle from one, rad.
    #[serde(with = "bits")]
    pub goal_angle: Option<f64>,
    /// By how much the re-integrated base attitude leaves the plan, rad; `None` where the plan was not
    /// re-integrated. Likewise the others.
    #[serde(with = "bits")]
    pub verification_attitude: Option<f64>,
    /// Of the base position, m.
    #[serde(with = "bits")]
    pub verification_position: Option<f64>,
    /// Of a joint, rad or m.
    #[serde(with = "bits")]
    pub verification_joint: Option<f64>,
    /// Time outside the solver, s.
    #[serde(with = "bits")]
    pub seconds_setup: f64,
    /// Time in evaluation callbacks, s.
    #[serde(with = "bits")]
    pub seconds_derivatives: f64,
    /// Time in the linear solver, s.
    #[serde(with = "bits")]
    pub seconds_linear_solver: f64,
    /// Time in the rest of Ipopt, s.
    #[serde(with = "bits")]
    pub seconds_ipopt_other: f64,
    /// Name of the linear solver used.
    pub linear_solver: String,
}

/// A planned motion, one row a time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Motion {
    /// Times of the nodes, s.
    #[serde(with = "bits")]
    pub t: Vec<f64>,
    /// Base attitude: angles in rad, or the parameters of another description.
    #[serde(with = "bits")]
    pub base_attitude: Vec<Vec<f64>>,
    /// Base position relative to the system's mass centre, m.
    #[serde(with = "bits")]
    pub base_position: Vec<Vec<f64>>,
    /// Rates of the base attitude, rad/s.
    #[serde(with = "bits")]
    pub base_rate: Vec<Vec<f64>>,
    /// Joint positions, rad or m.
    #[serde(with = "bits")]
    pub joint_position: Vec<Vec<f64>>,
    /// Joint rates, rad/s or m/s.
    #[serde(with = "bits")]
    pub joint_velocity: Vec<Vec<f64>>,
    /// Controls u = H⁻¹τ, rad/s² or m/s².
    #[serde(with = "bits")]
    pub control: Vec<Vec<f64>>,
    /// Joint torques, N·m or N.
    #[serde(with = "bits")]
    pub joint_torque: Vec<Vec<f64>>,
}

impl Record {
    /// A row that came to nothing.
    pub(super) fn lost(
        (position, key): (u64, String),
        status: RowStatus,
        reason: String,
        spent: Duration,
    ) -> Self {
        Self {
            position,
            key,
            name: String::new(),
            status,
            reason,
            cells: Vec::new(),
            figures: None,
            motion: None,
            seconds: spent.as_secs_f64(),
        }
    }
}

impl Figures {
    /// Those of `plan`.
    pub(super) fn of(plan: &Plan) -> Self {
        let (mesh, found, spent) = (&plan.discretization.mesh, &plan.metrics, &plan.timing);
        let largest =
            |of: fn(&GoalError) -> Option<f64>| plan.goals.iter().filter_map(of).reduce(f64::max);
        let checked = plan.verification.as_ref();
        Self {
            objective: plan.objective,
            max_error: plan.max_error,
            points: mesh.points(),
            segments: mesh.segments(),
            mesh_iterations: plan.iterations.len(),
            nlp_iterations: plan
                .iterations
                .iter()
                .map(|r| u64::from(r.nlp_iterations))
                .sum(),
            max_base_attitude: found.max_base_attitude,
            final_base_attitude: found.final_base_attitude,
            max_base_displacement: found.max_base_displacement,
            final_base_displacement: found.final_base_displacement,
            peak_joint_velocity: found.peak_joint_velocity,
            peak_joint_torque: found.peak_joint_torque,
            goal_distance: largest(|goal| goal.distance),
            goal_angle: largest(|goal| goal.angle),
            verification_attitude: checked.map(|found| found.max_base_attitude_drift),
            verification_position: checked.map(|found| found.max_base_position_drift),
            verification_joint: checked.map(|found| found.max_joint_drift),
            seconds_setup: spent.setup.as_secs_f64(),
            seconds_derivatives: spent.derivatives.as_secs_f64(),
            seconds_linear_solver: spent.linear_solver.as_secs_f64(),
            seconds_ipopt_other: spent.ipopt_other.as_secs_f64(),
            linear_solver: plan.linear_solver.clone(),
        }
    }
}

impl Motion {
    /// How many numbers it has.
    pub fn numbers(&self) -> usize {
        let rows = [
            &self.base_attitude,
            &self.base_position,
            &self.base_rate,
            &self.joint_position,
            &self.joint_velocity,
            &self.control,
            &self.joint_torque,
        ];
        let widths = rows
            .into_iter()
            .filter_map(|rows| rows.first())
            .map(Vec::len);
        self.t.len() * (1 + widths.sum::<usize>())
    }

    /// That of a plan.
    pub(super) fn of(planned: Trajectory) -> Self {
        let Trajectory {
            t,
            attitude: _,
            base_attitude,
            base_position,
            base_rate,
            joint_position,
            joint_velocity,
            control,
            joint_torque,
        } = planned;
        Self {
            t,
            base_attitude,
            base_position,
            base_rate,
            joint_position,
            joint_velocity,
            control,
            joint_torque,
        }
    }
}
