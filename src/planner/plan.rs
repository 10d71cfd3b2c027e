//! What a planner returns.

use super::{Method, Reached};
use crate::dynamics::attitude::SpatialAttitude;
use crate::nlp;
use crate::ocp::Interval;
use crate::refine::Record;
use crate::transcription::Discretization;
use std::time::Duration;

/// How planning ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// All limits hold and the largest error (28) is within the tolerance.
    Solved,
    /// No trajectory within the limits was found; the diagnosis says which cannot hold.
    Infeasible,
    /// The tolerance was not met within the mesh iterations, or the solver gave up.
    NotConverged,
    /// Stopped from outside.
    Interrupted,
}

impl Status {
    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solved => "solved",
            Self::Infeasible => "infeasible",
            Self::NotConverged => "not_converged",
            Self::Interrupted => "interrupted",
        }
    }
}

/// The planned motion, one row a time; rows are as long as the quantity has components.
#[derive(Debug, Clone, Default, PartialEq)]
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
pub struct Metrics {
    /// Largest magnitude of any base attitude angle, or else of the rotation angle, rad.
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

/// One limit that cannot hold.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitFinding {
    /// Key in the problem file ("limits.base_attitude").
    pub key: String,
    /// The bound as given, in the unit of the limit.
    pub bound: Interval,
    /// The component it is about ("base attitude", "base pitch", "joint 2 rate").
    pub component: String,
    /// Unit of the bounds: "rad", "m/s", "N·m" …
    pub unit: &'static str,
    /// How much the bound must give way at least, same unit.
    pub excess: f64,
    /// The smallest bound that was found to work, all other limits kept.
    pub smallest_bound: Interval,
}

/// Why a problem is infeasible.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Diagnosis {
    /// The limits that cannot hold, those relaxed together.
    pub limits: Vec<LimitFinding>,
    /// Starts tried and how many of them ended at a feasible relaxation.
    pub starts: [usize; 2],
    /// One sentence for a person, in degrees and centimetres.
    pub summary: String,
}

/// Where the time went.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Timing {
    /// Everything outside the solver: sparsity, meshes, errors, trajectory.
    pub setup: Duration,
    /// Evaluation callbacks.
    pub derivatives: Duration,
    /// Linear solver inside Ipopt.
    pub linear_solver: Duration,
    /// The rest of Ipopt.
    pub ipopt_other: Duration,
    /// All together.
    pub total: Duration,
}

/// Result of planning: complete whatever the status, so that the best trajectory is kept.
#[derive(Debug, Clone)]
pub struct Plan {
    /// How it ended.
    pub status: Status,
    /// Method used.
    pub method: Method,
    /// Cost J of (14), whatever cost the method itself knows.
    pub objective: f64,
    /// Tolerance asked for.
    pub tolerance: f64,
    /// Largest error (28) on the final mesh.
    pub max_error: f64,
    /// One record a mesh iteration, with the method's own cost; none where nothing is optimised.
    pub iterations: Vec<Record>,
    /// The trajectory on its mesh: states [η, θ, θ̇], controls u.
    pub discretization: Discretization,
    /// The last programme's primal and dual values, for a warm start.
    pub iterate: nlp::Iterate,
    /// The planned motion at the nodes.
    pub trajectory: Trajectory,
    /// Figures a person asks for first.
    pub metrics: Metrics,
    /// The goals for the end effector, in the order of time, and how near they are met.
    pub goals: Vec<Reached>,
    /// Why there is no plan; only where the status is infeasible.
    pub diagnosis: Option<Diagnosis>,
    /// What a user should know before using the plan, a sentence each.
    pub warnings: Vec<String>,
    /// Name of the linear solver used ([`nlp::LinearSolver::name`]), or "none"; "multifrontal, mumps"
    /// where MUMPS had to do some of the solves again.
    pub linear_solver: String,
    /// Where the time went.
    pub timing: Timing,
}
