//! The history of a refinement.

use super::Verdict;
use crate::nlp;
use std::time::Duration;

/// What the refinement decided for one segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Decision {
    /// Within the tolerance: left as it is.
    Keep,
    /// Degree raised to this many points, eq. (32).
    Raise(usize),
    /// Divided into this many segments, eq. (30).
    Divide(usize),
}

/// One mesh iteration. Errors are NaN where the problem's functions are.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Record {
    /// Collocation points.
    pub points: usize,
    /// Segments.
    pub segments: usize,
    /// Breakpoints, fractions of the duration; length segments + 1.
    pub breakpoints: Vec<f64>,
    /// Largest error (28) of each state in each segment, segments × states.
    pub segment_errors: Vec<Vec<f64>>,
    /// Largest error (28).
    pub max_error: f64,
    /// Largest relative error of the states by quadrature on a finer LGR set.
    pub quadrature_error: f64,
    /// Largest part of its size by which a bound is exceeded between the nodes; 0 where none is,
    /// infinite where the bounded quantity is NaN.
    pub max_violation: f64,
    /// What is left for another mesh to bring down: the part of its size by which a state or a row of
    /// the states is outside, or the part of the duration for which a control or a row of the
    /// controls overshoots by more than a tenth of its size in one segment.
    pub removable_violation: f64,
    /// Objective (25).
    pub objective: f64,
    /// J without the error of the mesh, less `objective`: to first order, by the multipliers. NaN where a
    /// function is, or the solver left no multipliers.
    pub objective_error: f64,
    /// Iterations of the solver.
    pub nlp_iterations: u32,
    /// How the solver ended.
    pub nlp_status: nlp::Status,
    /// Whether the solution on this mesh counts, and if not, why.
    pub verdict: Verdict,
    /// Wall time of the iteration, set-up and error estimate included.
    pub time: Duration,
    /// What was decided for each segment; empty where the refinement ended here.
    pub decisions: Vec<Decision>,
}
