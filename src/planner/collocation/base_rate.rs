//! The integral of the base rate as the only cost, after Schulz: by the same machinery as A-RPM.
//!
//! Derived in docs/algorithms.md#base-rate-alone.

use super::Planner;
use crate::nlp::Control;
use crate::planner::{Event, Method, Plan, PlanError};
use crate::problem::{Cost, CostId, Problem};
use crate::refine::{self, Start};
use crate::system::cost_terms;

/// Weight of ∫‖u‖² beside that of one on ∫‖η̇‖², rad²/s³ against rad²/s.
///
/// The base rate alone leaves the control out of the cost, and motions that do not turn the base
/// cost nothing at all: the problem is singular.
pub const REGULARIZATION: f64 = 1e-3;

/// Plans `problem` with the cost ∫‖η̇‖² dt instead of its own.
///
/// # Errors
/// [`PlanError`]; an infeasible or unconverged problem is no error but a
/// [`Status`](crate::planner::Status).
pub(in crate::planner) fn plan(
    planner: &mut Planner,
    problem: &Problem,
    start: Option<&Start>,
    monitor: &mut dyn FnMut(&Event<'_>) -> Control,
) -> Result<Plan, PlanError> {
    let own = problem.edited(|own| {
        own.mesh.method = refine::Method::Adaptive;
        base_rate_alone(&mut own.cost);
    })?;
    let mut plan = planner.plan_with(&own, start, monitor)?;
    plan.method = Method::BaseRate;
    plan.cost_terms = cost_terms(problem, &plan.discretization);
    plan.objective = plan.cost_terms.total();
    Ok(plan)
}

fn base_rate_alone(cost: &mut Cost) {
    for entry in cost.entries_mut() {
        entry.weights.fill(match entry.id {
            CostId::BaseRate => 1.0,
            CostId::Control => REGULARIZATION,
            _ => 0.0,
        });
    }
    cost.duration = 0.0;
    cost.rate_matrix = None;
}
