//! What a planner returns.

use super::Method;
use crate::nlp;
use crate::ocp::Interval;
use crate::problem::{LimitId, Unit};
use crate::refine::Record;
use crate::system::{Component, CostTerms, GoalError, Metrics, Trajectory};
use crate::transcription::Discretization;
use crate::verify::Verification;
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// How planning ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
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

    /// The same in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::NotConverged => "not converged",
            other => other.name(),
        }
    }
}

/// One limit that cannot hold, or that no motion was found to keep.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LimitFinding {
    /// The limit.
    pub limit: LimitId,
    /// Which component of it.
    pub component: Component,
    /// What a person calls that component ("base attitude", "base pitch", "rate of joint elbow").
    pub name: String,
    /// Unit of the bounds.
    pub unit: Unit,
    /// The bound as given.
    pub bound: Interval,
    /// How much the bound must give way at least, same unit.
    pub excess: f64,
    /// The smallest bound that was found to work, all other limits kept.
    pub smallest_bound: Interval,
    /// A proven lower bound: no bound below it can work, whatever the other limits. The upper end, same
    /// unit; `None` where none above `bound` is known.
    pub floor: Option<f64>,
}

/// How many starts a search was begun from.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct StartCounts {
    /// All of them.
    pub tried: usize,
    /// Those that ended at a trajectory within the limits, or within the relaxed ones.
    pub feasible: usize,
}

/// Why a problem is infeasible.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct Diagnosis {
    /// The limits that cannot hold, those relaxed together.
    pub limits: Vec<LimitFinding>,
    /// Whether the motion with these limits relaxed was refined to the tolerance. Where it was not,
    /// the bounds are those of a mesh that is too coarse, and need not work.
    pub converged: bool,
    /// The starts that were tried.
    pub starts: StartCounts,
    /// One sentence for a person, in degrees and centimetres.
    pub summary: String,
}

/// Where the time went.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
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
#[non_exhaustive]
pub struct Plan {
    /// How it ended.
    pub status: Status,
    /// Method used.
    pub method: Method,
    /// Cost J of (14), whatever cost the method itself knows.
    pub objective: f64,
    /// Its terms, each with its weight; their sum is J.
    pub cost_terms: CostTerms,
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
    pub goals: Vec<GoalError>,
    /// Why there is no plan; only where the status is infeasible.
    pub diagnosis: Option<Diagnosis>,
    /// What re-integration found; `None` before [`Plan::verify`], or where it failed.
    pub verification: Option<Verification>,
    /// What a user should know before using the plan, a sentence each.
    pub warnings: Vec<String>,
    /// Name of the linear solver used ([`nlp::LinearSolver::name`]), or "none"; "multifrontal, mumps"
    /// where MUMPS had to do some of the solves again.
    pub linear_solver: String,
    /// Where the time went.
    pub timing: Timing,
}
