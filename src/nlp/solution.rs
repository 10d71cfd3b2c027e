//! What a solve returns: a graded status, the iterate and where the time went.

use super::Iterate;
use std::time::Duration;

/// How a solve ended, graded from best to worst.
#[non_exhaustive]
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

/// How often each function of a programme was evaluated.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Evaluations {
    /// The objective.
    pub objective: u32,
    /// Its gradient.
    pub gradient: u32,
    /// The constraints.
    pub constraints: u32,
    /// Their Jacobian.
    pub jacobian: u32,
    /// The Hessian of the Lagrangian.
    pub hessian: u32,
}

impl Evaluations {
    /// Adds the counts of another solve.
    fn add(&mut self, other: &Self) {
        self.objective += other.objective;
        self.gradient += other.gradient;
        self.constraints += other.constraints;
        self.jacobian += other.jacobian;
        self.hessian += other.hessian;
    }
}

/// Why MUMPS takes a solve over from the multifrontal linear solver.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum HandOver {
    /// It failed. The solve is begun again.
    Failed,
    /// Its systems were singular, iteration after iteration, as of rows that depend on each other.
    /// The solve goes on from where it was, or is begun again where that was no way out.
    Singular,
    /// Delayed pivots made its factors many times longer than foreseen. The solve goes on from where
    /// it was.
    Growth,
}

/// Counts and times of one solve, or of several together.
///
/// A solve that MUMPS has taken over counts as one, with the iterations, evaluations and times of
/// both attempts.
#[non_exhaustive]
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
    /// Evaluations of each function.
    pub evaluations: Evaluations,
    /// Time in all evaluation callbacks together.
    pub derivatives: Duration,
    /// Time in the linear solver; zero where it was not asked for.
    pub linear_solver: Duration,
    /// Number of solves.
    pub solves: u32,
    /// How many of them MUMPS has taken over from the multifrontal linear solver.
    pub fallbacks: u32,
    /// How many of those since systems were singular on and on: [`HandOver::Singular`].
    pub singular_fallbacks: u32,
    /// How many of those since the factors had grown: [`HandOver::Growth`].
    pub growth_fallbacks: u32,
    /// Wall time of the whole solve, callbacks included.
    pub total: Duration,
}

impl Statistics {
    /// Adds the counts and times of another solve; barrier and infeasibilities become its.
    pub fn add(&mut self, other: &Self) {
        self.iterations += other.iterations;
        self.evaluations.add(&other.evaluations);
        self.derivatives += other.derivatives;
        self.linear_solver += other.linear_solver;
        self.solves += other.solves;
        self.fallbacks += other.fallbacks;
        self.singular_fallbacks += other.singular_fallbacks;
        self.growth_fallbacks += other.growth_fallbacks;
        self.total += other.total;
        self.barrier = other.barrier;
        self.primal_infeasibility = other.primal_infeasibility;
        self.dual_infeasibility = other.dual_infeasibility;
    }

    /// Counts this solve as one that MUMPS has taken over.
    pub(super) fn taken_over(&mut self, why: HandOver) {
        self.solves = 1;
        self.fallbacks = 1;
        self.singular_fallbacks = u32::from(why == HandOver::Singular);
        self.growth_fallbacks = u32::from(why == HandOver::Growth);
    }

    /// A sentence for the user where MUMPS had to stand in for the multifrontal linear solver.
    pub fn fallback_warning(&self) -> Option<String> {
        let failed = self.fallbacks - self.singular_fallbacks - self.growth_fallbacks;
        let reasons = [
            (
                failed,
                "did them again from their start where it had failed",
            ),
            (
                self.singular_fallbacks,
                "went on where the systems were singular iteration after iteration, as of conditions \
                 that depend on each other",
            ),
            (
                self.growth_fallbacks,
                "went on where delayed pivots had made the factors many times longer than foreseen",
            ),
        ];
        let said = reasons.iter().filter(|(count, _)| *count > 0);
        let said: Vec<String> = said
            .map(|(count, why)| format!("{why} ({count})"))
            .collect();
        (self.fallbacks > 0).then(|| {
            format!(
                "MUMPS stood in for the multifrontal linear solver in {} of {} solves: it {}",
                self.fallbacks,
                self.solves,
                said.join(", ")
            )
        })
    }
}

/// Result of one solve.
#[non_exhaustive]
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
#[non_exhaustive]
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
