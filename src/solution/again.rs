//! A saved plan judged again, and its figures made again: what a file says may be old, or edited.

use super::write::{cost_terms, goals, metrics, verification};
use super::{Saved, Solution};
use crate::planner::{Doubt, Judgement, Status, judge, judge_solved};
use crate::system;

/// Part of J by which the saved one may be off the cost of the motion: that of rounding.
const ROUNDING: f64 = 1e-9;

impl Saved {
    /// Judges the plan now, as [`Plan::verify`](crate::planner::Plan::verify) does once it is made;
    /// one that is said to be solved also by its task and limits.
    pub fn judge(&self) -> Judgement {
        match self.solution.status {
            Status::Solved => judge_solved(&self.file.problem, &self.plan),
            _ => judge(&self.file.problem, &self.plan),
        }
    }

    /// The solution with its re-integration, figures, goals and cost made again, and why it is not
    /// what it says, where that is so: a solved plan in doubt counts as not converged.
    ///
    /// Errors and limits between the nodes stay those of planning. Infeasible and interrupted plans
    /// are not integrated again: they are none to be used.
    pub fn again(&self) -> (Solution, Option<Doubt>) {
        let (problem, plan) = (&self.file.problem, &self.plan);
        let terms = system::cost_terms(problem, plan);
        let mut found = Solution {
            metrics: metrics(&system::metrics_of(problem, plan)),
            goals: goals(&system::goal_errors(problem, plan)),
            cost_terms: cost_terms(&terms, problem.has_rotation_angle()),
            verification: None,
            ..self.solution.clone()
        };
        let cost = terms.total();
        let same = (found.objective - cost).abs() <= ROUNDING * (1.0 + cost.abs());
        if !same {
            found.objective = cost;
        }
        if matches!(found.status, Status::Infeasible | Status::Interrupted) {
            return (found, None);
        }
        let judgement = self.judge();
        found.verification = judgement.verification.as_ref().map(verification);
        let doubt = judgement.doubt.filter(|_| found.status == Status::Solved);
        if let Some(doubt) = &doubt {
            found.status = Status::NotConverged;
            found.warnings.push(doubt.to_string());
        }
        (found, doubt)
    }
}
