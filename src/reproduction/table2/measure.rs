//! What is measured of a plan, or of several of the same.

use crate::planner::Status;
use crate::problem::Problem;
use crate::refine::Method;
use crate::report::{exact, short};
use crate::reproduction::{ReproductionError, Run, Session};
use serde::{Serialize, Serializer};

fn by_name<S: Serializer>(method: &Method, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(method.name())
}

/// What is measured of several runs of one problem.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Measured {
    /// Method; written by its name in files.
    #[serde(serialize_with = "by_name")]
    pub method: Method,
    /// Whether the largest error is within the tolerance.
    pub reached: bool,
    /// How planning ended.
    pub status: &'static str,
    /// Collocation points of the last mesh.
    pub points: usize,
    /// Segments of the last mesh.
    pub segments: usize,
    /// Meshes solved.
    pub solves: usize,
    /// Iterations of Ipopt on all meshes together.
    pub nlp_iterations: u32,
    /// Median wall time, s.
    pub seconds: f64,
    /// Median processor time, s.
    pub cpu_seconds: f64,
    /// Largest error (28) on the last mesh.
    pub max_error: Option<f64>,
    /// Largest relative error of the states by quadrature on a finer LGR set, last mesh.
    pub quadrature_error: Option<f64>,
    /// Cost J.
    pub objective: Option<f64>,
}

impl Measured {
    /// Plans `problem` `repeat` times by `method`.
    ///
    /// # Errors
    /// Those of [`Session::plan`].
    pub fn of(
        session: &mut Session<'_>,
        problem: &Problem,
        method: Method,
        repeat: u16,
    ) -> Result<Self, ReproductionError> {
        let title = format!(
            "{}, {} to {:e}",
            problem.name,
            method.name(),
            problem.mesh.tolerance
        );
        let problem = problem.edited(|problem| problem.mesh.method = method)?;
        let mut runs: Vec<Run> = Vec::new();
        for _ in 0..repeat.max(1) {
            runs.push(session.plan(&title, &problem, None)?);
        }
        let plan = &runs[0].plan;
        let finite = |value: f64| value.is_finite().then_some(value);
        let last = plan.iterations.last();
        Ok(Self {
            method,
            reached: plan.status == Status::Solved,
            status: plan.status.name(),
            points: plan.discretization.mesh.points(),
            segments: plan.discretization.mesh.segments(),
            solves: plan.iterations.len(),
            nlp_iterations: plan.iterations.iter().map(|r| r.nlp_iterations).sum(),
            seconds: median(runs.iter().map(|run| run.plan.timing.total.as_secs_f64())),
            cpu_seconds: median(runs.iter().map(|run| run.cpu_seconds)),
            max_error: finite(plan.max_error),
            quadrature_error: last.and_then(|record| finite(record.quadrature_error)),
            objective: finite(plan.objective),
        })
    }

    /// Names of [`Self::cells`].
    pub(super) const COLUMNS: [&str; 11] = [
        "reached",
        "status",
        "points",
        "segments",
        "solves",
        "nlp_iterations",
        "seconds",
        "cpu_seconds",
        "max_error",
        "quadrature_error",
        "objective",
    ];

    /// Every figure with all its digits.
    pub(super) fn cells(&self) -> [String; 11] {
        let optional = |value: Option<f64>| exact(value.unwrap_or(f64::NAN));
        [
            self.reached.to_string(),
            self.status.into(),
            self.points.to_string(),
            self.segments.to_string(),
            self.solves.to_string(),
            self.nlp_iterations.to_string(),
            exact(self.seconds),
            exact(self.cpu_seconds),
            optional(self.max_error),
            optional(self.quadrature_error),
            optional(self.objective),
        ]
    }

    /// The error, marked where it is above the tolerance.
    pub(super) fn error_cell(&self) -> String {
        let error = short(self.max_error.unwrap_or(f64::NAN));
        if self.reached {
            error
        } else {
            format!("{error}, not reached")
        }
    }
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    match values.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => values[n / 2],
        n => 0.5 * (values[n / 2 - 1] + values[n / 2]),
    }
}
