//! `solution.json`, name by name.

use super::{Provenance, number};
use crate::planner::Status;
use crate::system::StartKind;
use serde::{Deserialize, Serialize};

/// The whole file. SI units and radians; numbers that are not finite are null.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Solution {
    /// Version of the format, 1.
    pub schema: u32,
    /// Name of the problem.
    pub name: String,
    /// "solved", "infeasible", "not_converged" or "interrupted".
    pub status: Status,
    /// "a-rpm" or "rpm".
    pub method: String,
    /// Cost J of (14).
    #[serde(with = "number")]
    pub objective: f64,
    /// Its terms, each with its weight; empty in files that do not say.
    #[serde(default)]
    pub cost_terms: Vec<CostTerm>,
    /// Tolerance asked for.
    #[serde(with = "number")]
    pub tolerance: f64,
    /// Largest error (28) on the final mesh.
    #[serde(with = "number")]
    pub max_error: f64,
    /// Collocation points of the final mesh.
    pub points: usize,
    /// Segments of the final mesh.
    pub segments: usize,
    /// One a mesh iteration.
    pub iterations: Vec<Iteration>,
    /// The final mesh.
    pub mesh: Mesh,
    /// The joints, in the order of the columns of `trajectory`; empty in files that do not say.
    #[serde(default)]
    pub joints: Vec<JointColumn>,
    /// The frames that `trajectory` is told in, in words; empty in files that do not say.
    #[serde(default)]
    pub frames: String,
    /// The planned motion at the nodes.
    pub trajectory: Trajectory,
    /// Figures a person asks for first.
    pub metrics: Metrics,
    /// Goals for the end effector, in the order of time, and how near they are met.
    #[serde(default)]
    pub goals: Vec<Goal>,
    /// What a search from many starts found; null where the plan began with one.
    #[serde(default)]
    pub search: Option<Search>,
    /// Independent re-integration; null where there was none.
    pub verification: Option<Verification>,
    /// Why there is no plan; null unless infeasible.
    pub diagnosis: Option<Diagnosis>,
    /// What a user should know before using the plan.
    #[serde(default)]
    pub warnings: Vec<String>,
    /// Where the time went.
    pub timing: Timing,
    /// What was solved by what.
    pub provenance: Provenance,
    /// The last programme's primal and dual values, for `--warm-start`.
    #[serde(default)]
    pub iterate: Option<Iterate>,
}

/// A term of the cost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct CostTerm {
    /// Key of its weights in the problem file.
    pub key: String,
    /// The term as a formula.
    pub formula: String,
    /// Its value, with its weights.
    #[serde(with = "number")]
    pub value: f64,
}

/// A search from many starts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Search {
    /// What the random numbers began with.
    pub seed: u64,
    /// Starts that were tried.
    pub tried: usize,
    /// Those that were solved on the first mesh.
    pub solved: usize,
    /// The distinct optima, the best first.
    pub optima: Vec<Optimum>,
    /// What no motion can do better than, for planar arms with two joints; null elsewhere.
    #[serde(default)]
    pub lower_bounds: Option<LowerBounds>,
}

/// Lower bounds by dynamic programming over two joints.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct LowerBounds {
    /// Of the largest base angle along the path, rad.
    #[serde(with = "number")]
    pub max_base_attitude: f64,
    /// Of the base angle at t_f, rad.
    #[serde(with = "number")]
    pub final_base_attitude: f64,
}

/// An optimum that starts ended at.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Optimum {
    /// Cost J; on the first mesh where it was not refined.
    #[serde(with = "number")]
    pub objective: f64,
    /// Largest base angle along the path, rad.
    #[serde(with = "number")]
    pub max_base_attitude: f64,
    /// Base angle at t_f, rad.
    #[serde(with = "number")]
    pub final_base_attitude: f64,
    /// How many starts ended there.
    pub hits: usize,
    /// The first of them, counted from 0.
    pub start: usize,
    /// What that start was: "straight", "loop", "detour", "other-goal", "reaction-null-space" or
    /// "given".
    pub kind: StartKind,
    /// How its refinement ended; null where it was not refined.
    pub status: Option<Status>,
}

fn nan() -> f64 {
    f64::NAN
}

/// One mesh iteration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Iteration {
    /// Collocation points.
    pub points: usize,
    /// Segments.
    pub segments: usize,
    /// Largest error (28).
    #[serde(with = "number")]
    pub max_error: f64,
    /// Largest relative error of the states by quadrature on a finer LGR set.
    #[serde(with = "number")]
    pub quadrature_error: f64,
    /// Largest part of its size by which a bound is exceeded between the nodes.
    #[serde(with = "number", default)]
    pub max_violation: f64,
    /// Objective (25).
    #[serde(with = "number")]
    pub objective: f64,
    /// J without the error of the mesh, less `objective`: to first order, by the multipliers.
    #[serde(with = "number", default = "nan")]
    pub objective_error: f64,
    /// Iterations of the solver.
    pub nlp_iterations: u32,
    /// How the solver ended, in words.
    pub nlp_status: String,
    /// Wall time, s.
    #[serde(with = "number")]
    pub seconds: f64,
}

/// A mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Mesh {
    /// Fractions of the duration from 0 to 1; length segments + 1.
    pub breakpoints: Vec<f64>,
    /// LGR points of each segment; length segments.
    pub points_per_segment: Vec<usize>,
}

/// A joint, with the units of its columns.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct JointColumn {
    /// Name in the robot's file.
    pub name: String,
    /// "revolute" or "prismatic".
    pub kind: String,
    /// Unit of `joint_position`.
    pub position: String,
    /// Unit of `joint_velocity`.
    pub velocity: String,
    /// Unit of `control`.
    pub control: String,
    /// Unit of `joint_torque`.
    pub torque: String,
}

/// The planned motion, one row a time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Trajectory {
    /// Times of the nodes, s; the last is t_f.
    pub t: Vec<f64>,
    /// How `base_attitude` describes the orientation: "angle" in the plane, else "roll-pitch-yaw",
    /// "quaternion" (w, x, y, z) or "mrp"; empty in files that do not say.
    #[serde(default)]
    pub attitude: String,
    /// Base attitude: angles in rad, or the parameters of another description.
    pub base_attitude: Vec<Vec<f64>>,
    /// Base position relative to the system's mass centre, m.
    pub base_position: Vec<Vec<f64>>,
    /// Rates of the base attitude angles, or else the angular velocity in base axes, rad/s.
    pub base_rate: Vec<Vec<f64>>,
    /// Joint positions, rad or m.
    pub joint_position: Vec<Vec<f64>>,
    /// Joint rates, rad/s or m/s.
    pub joint_velocity: Vec<Vec<f64>>,
    /// Controls u = H⁻¹τ, rad/s² or m/s².
    pub control: Vec<Vec<f64>>,
    /// Joint torques, N·m or N.
    pub joint_torque: Vec<Vec<f64>>,
}

/// Figures a person asks for first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Metrics {
    /// Largest base angle, rad: of the rotation out of the axes the attitude is counted from.
    #[serde(with = "number")]
    pub max_base_attitude: f64,
    /// The same at t_f, rad.
    #[serde(with = "number")]
    pub final_base_attitude: f64,
    /// Largest distance of the base from where it started, m.
    #[serde(with = "number")]
    pub max_base_displacement: f64,
    /// The same at t_f, m.
    #[serde(with = "number")]
    pub final_base_displacement: f64,
    /// Largest magnitude of any joint rate, rad/s or m/s.
    #[serde(with = "number")]
    pub peak_joint_velocity: f64,
    /// Largest magnitude of any joint torque, N·m or N.
    #[serde(with = "number")]
    pub peak_joint_torque: f64,
}

/// A goal for the end effector.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Goal {
    /// Key in the problem file.
    pub key: String,
    /// When, s.
    pub t: f64,
    /// Distance from the position asked for, m; null where none was.
    pub distance: Option<f64>,
    /// Angle from the orientation asked for, rad; null where none was.
    pub angle: Option<f64>,
}

/// Largest differences between the plan and its independent re-integration.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Verification {
    /// Base attitude, rad.
    #[serde(with = "number")]
    pub max_base_attitude_drift: f64,
    /// Base position, m.
    #[serde(with = "number")]
    pub max_base_position_drift: f64,
    /// Joint positions, rad or m.
    #[serde(with = "number")]
    pub max_joint_drift: f64,
    /// Base attitude where the joints follow the planned path, rad.
    #[serde(with = "number")]
    pub replay_base_attitude_drift: f64,
    /// Base position where the joints follow the planned path, m.
    #[serde(with = "number")]
    pub replay_base_position_drift: f64,
    /// Largest linear momentum, kg m/s.
    #[serde(with = "number")]
    pub max_linear_momentum: f64,
    /// Largest angular momentum about the system's mass centre, kg m²/s.
    #[serde(with = "number")]
    pub max_angular_momentum: f64,
    /// Largest gap between kinetic energy and the joints' work, J.
    #[serde(with = "number")]
    pub max_energy_gap: f64,
    /// Steps of the integrator.
    pub steps: usize,
}

/// Why a problem is infeasible.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Diagnosis {
    /// One sentence for a person, in degrees and centimetres.
    pub summary: String,
    /// The limits that cannot hold, relaxed together.
    pub limits: Vec<LimitFinding>,
    /// Starts tried.
    pub starts: usize,
    /// Starts that ended at a feasible relaxation.
    pub feasible_starts: usize,
}

/// One limit that cannot hold; bounds are [lower, upper], null where there is none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct LimitFinding {
    /// Key in the problem file.
    pub key: String,
    /// The component it is about.
    pub component: String,
    /// The bound as given.
    pub bound: [Option<f64>; 2],
    /// Unit of bounds and excess; empty in files that do not say.
    #[serde(default)]
    pub unit: String,
    /// How much it must give way at least.
    #[serde(with = "number")]
    pub excess: f64,
    /// The smallest bound that was found to work.
    pub smallest_bound: [Option<f64>; 2],
    /// The bound below which none can work; absent where none above `bound` is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub floor: Option<f64>,
}

/// Where the time went, s.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Timing {
    /// Everything outside the solver.
    #[serde(with = "number")]
    pub setup: f64,
    /// Evaluation callbacks.
    #[serde(with = "number")]
    pub derivatives: f64,
    /// Linear solver inside Ipopt.
    #[serde(with = "number")]
    pub linear_solver: f64,
    /// The rest of Ipopt.
    #[serde(with = "number")]
    pub ipopt_other: f64,
    /// All together.
    #[serde(with = "number")]
    pub total: f64,
}

/// Primal and dual values of the last programme, in its own order and scaling.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Iterate {
    /// Variables.
    pub x: Vec<f64>,
    /// Constraint multipliers.
    pub multipliers: Vec<f64>,
    /// Multipliers of the lower bounds.
    pub lower_multipliers: Vec<f64>,
    /// Multipliers of the upper bounds.
    pub upper_multipliers: Vec<f64>,
}
