//! The factors of a sweep, and the problem whose cost they weigh.

use crate::problem::{ComponentKind, Cost, CostEntry, Problem, ProblemError};

/// `count` factors from `from` to `to`, both included, in even ratios.
pub fn factors(from: f64, to: f64, count: u16) -> Vec<f64> {
    let steps = i32::from(count.max(2)) - 1;
    let ratio = (to / from).powf(1.0 / f64::from(steps));
    let at = |k| if k == steps { to } else { from * ratio.powi(k) };
    (0..=steps).map(at).collect()
}

/// `problem` with weights on both sides of its cost, and what was added where there were none.
pub fn balanced(problem: &Problem) -> (Problem, Vec<String>) {
    let mut notes = Vec::new();
    let none = |cost: &Cost, on_base: bool| {
        let side = |entry: &CostEntry<_>| entry.components.is_on_base() == on_base;
        let mut weights = cost.entries().filter(side).flat_map(|entry| entry.weights);
        cost.rate_matrix.is_none() && weights.all(|weight| *weight == 0.0)
    };
    let problem = problem.edited(|problem| {
        let cost = &mut problem.cost;
        if none(cost, true) {
            cost.base_rate.fill(1.0);
            notes.push("The cost has no weight on the base; ∫‖η̇‖² was added.".into());
        }
        if none(cost, false) {
            cost.control.fill(1.0);
            notes.push("The cost has no weight on the joints; ∫‖u‖² was added.".into());
        }
    });
    (problem.expect("weights of one are valid"), notes)
}

/// The problem with the weights on the base times `factor`; Λ as a matrix from both sides, with its
/// root on the base's rates, so that it stays semidefinite.
pub(super) fn scaled(problem: &Problem, factor: f64) -> Result<Problem, ProblemError> {
    let angles = problem.component_count(ComponentKind::BaseRate);
    problem.edited(|problem| {
        problem.limits.base_motion *= factor;
        let cost = &mut problem.cost;
        for entry in cost.entries_mut().filter(|e| e.components.is_on_base()) {
            for weight in entry.weights {
                *weight *= factor;
            }
        }
        if let Some(matrix) = &mut cost.rate_matrix {
            let side = |i: usize| if i < angles { factor.sqrt() } else { 1.0 };
            for (i, row) in matrix.iter_mut().enumerate() {
                for (j, value) in row.iter_mut().enumerate() {
                    *value *= side(i) * side(j);
                }
            }
        }
    })
}
