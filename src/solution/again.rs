//! A saved plan judged again, and its figures made again: what a file says may be old, or edited.

use super::write::{cost_terms, goals, metrics, trajectory, verification};
use super::{Saved, Solution};
use crate::numeric::largest_or_nan;
use crate::planner::{Doubt, Judgement, Status, judge, judge_solved};
use crate::system;

/// Part of J by which the saved one may be off the cost of the motion: that of rounding.
const ROUNDING: f64 = 1e-9;
/// Part of the largest of its kind by which a saved figure may be off what follows from the motion.
const SAME: f64 = 1e-6;
/// Difference of two figures in SI units that is rounding, whatever their size.
const NOTHING: f64 = 1e-12;

impl Saved {
    /// Judges the plan now, as [`Plan::verify`](crate::planner::Plan::verify) does once it is made;
    /// one that is said to be solved also by its task, its limits and what follows from its motion.
    pub fn judge(&self) -> Judgement {
        let (problem, plan) = (&self.file.problem, &self.plan);
        if self.solution.status != Status::Solved {
            return judge(problem, plan);
        }
        let mut found = judge_solved(problem, plan);
        if found.doubt.is_none() {
            found.doubt = self.derived();
        }
        found
    }

    /// The first figure of the trajectory that does not follow from its states and controls.
    fn derived(&self) -> Option<Doubt> {
        let saved = &self.solution.trajectory;
        let follows = system::at_nodes(&self.file.problem, &self.plan);
        let columns = [
            (
                "base position",
                &saved.base_position,
                &follows.base_position,
            ),
            ("base rate", &saved.base_rate, &follows.base_rate),
            ("joint torque", &saved.joint_torque, &follows.joint_torque),
        ];
        columns.into_iter().find_map(|(name, saved, follows)| {
            let room = SAME * largest_or_nan(follows.iter().flatten().map(|value| value.abs()));
            let rows = saved.iter().zip(follows).enumerate();
            let mut pairs =
                rows.flat_map(|(k, (a, b))| a.iter().zip(b).map(move |(a, b)| (k, *a, *b)));
            let (k, found, expected) = pairs.find(|(_, a, b)| (a - b).abs() > room.max(NOTHING))?;
            Some(Doubt::Derived {
                name,
                time: self.solution.trajectory.t[k],
                found,
                expected,
            })
        })
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
            trajectory: trajectory(&system::at_nodes(problem, plan)),
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
