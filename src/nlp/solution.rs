//! What a solve returns: a graded status, the iterate and where the time went.

use super::Iterate;
use std::time::Duration;

/// How a solve ended, graded from best to worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Status {
    /// Optimal to the tolerance.
    Solved,
    /// Optimal only to the solver's looser, acceptable tolerance.
    SolvedToAcceptableLevel,
    /// A point was found that satisfies a square system or only the constraints.
    FeasiblePointFound,
    /// The solver converged to a point of locally least infeasibility.
    LocallyInfeasible,
    /// Steps became too small to go on.
    SearchDirectionTooSmall,
    /// Iterates run away.
    Diverging,
    /// The restoration phase failed.
    RestorationFailed,
    /// The iteration limit was met.
    MaxIterations,
    /// The time limit was met.
    TimeLimit,
    /// Stopped by the monitor or by an interrupt.
    Interrupted,
    /// A function could not be evaluated where it had to be.
    InvalidNumber,
    /// More equality constraints than free variables.
    TooFewDegreesOfFreedom,
    /// Out of memory, or an error inside the solver; the solver's own code is kept.
    Internal(i32),
}

impl Status {
    /// Whether the result may be used as an optimum.
    pub fn is_solved(self) -> bool {
        matches!(self, Self::Solved | Self::SolvedToAcceptableLevel)
    }

    /// One plain phrase, for a report.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Solved => "solved",
            Self::SolvedToAcceptableLevel => "solved to the acceptable level only",
            Self::FeasiblePointFound => "feasible point found",
            Self::LocallyInfeasible => "locally infeasible",
            Self::SearchDirectionTooSmall => "search direction too small",
            Self::Diverging => "iterates diverge",
            Self::RestorationFailed => "restoration failed",
            Self::MaxIterations => "iteration limit met",
            Self::TimeLimit => "time limit met",
            Self::Interrupted => "interrupted",
            Self::InvalidNumber => "a function is not finite",
            Self::TooFewDegreesOfFreedom => "too few degrees of freedom",
            Self::Internal(_) => "internal error of the solver",
        }
    }
}

/// Counts and times of one solve.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Statistics {
    /// Iterations of the interior-point method.
    pub iterations: u32,
    /// Barrier parameter at the end.
    pub barrier: f64,
    /// Primal infeasibility at the end (unscaled, as the intermediate callback saw it).
    pub primal_infeasibility: f64,
    /// Dual infeasibility at the end.
    pub dual_infeasibility: f64,
    /// Calls of the objective, its gradient, the constraints, the Jacobian and the Hessian.
    pub evaluations: [u32; 5],
    /// Time in all evaluation callbacks together.
    pub derivatives: Duration,
    /// Time in the linear solver; zero where it was not asked for.
    pub linear_solver: Duration,
    /// Solves that our own linear solver could not serve and MUMPS took over.
    pub fallbacks: u32,
    /// Wall time of the whole solve, callbacks included.
    pub total: Duration,
}

impl Statistics {
    /// Adds the counts and times of another solve; barrier and infeasibilities become its.
    pub fn add(&mut self, other: &Self) {
        self.iterations += other.iterations;
        for (mine, theirs) in self.evaluations.iter_mut().zip(other.evaluations) {
            *mine += theirs;
        }
        self.derivatives += other.derivatives;
        self.linear_solver += other.linear_solver;
        self.fallbacks += other.fallbacks;
        self.total += other.total;
        self.barrier = other.barrier;
        self.primal_infeasibility = other.primal_infeasibility;
        self.dual_infeasibility = other.dual_infeasibility;
    }
}

/// Result of one solve.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// How it ended.
    pub status: Status,
    /// Objective at the final iterate.
    pub objective: f64,
    /// Final primal and dual values.
    pub iterate: Iterate,
    /// Constraint values g(x), length m.
    pub constraints: Vec<f64>,
    /// Counts and times.
    pub statistics: Statistics,
}

/// What the monitor sees after each iteration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Iteration count.
    pub iteration: u32,
    /// Whether the iteration was in the restoration phase.
    pub restoration: bool,
    /// Objective.
    pub objective: f64,
    /// Primal infeasibility.
    pub primal_infeasibility: f64,
    /// Dual infeasibility.
    pub dual_infeasibility: f64,
    /// Barrier parameter.
    pub barrier: f64,
    /// Regularisation of the Hessian, 0 where none was needed.
    pub regularization: f64,
    /// Primal and dual step lengths.
    pub steps: [f64; 2],
    /// Backtracking steps of the line search.
    pub line_search_trials: u32,
}

/// The monitor's answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Control {
    /// Go on.
    Continue,
    /// Stop at the next chance; the solve ends as [`Status::Interrupted`].
    Stop,
}
