//! The trade-off between the base's motion and the joints' effort.
//!
//! The cost (14) is split into what is about the base, B, and what is about the joints, E. Its
//! minimisers with κB + E instead of B + E, κ from small to large, are points of the Pareto front
//! of the two: B falls and E rises along it.

use crate::nlp::Control;
use crate::planner::{Event, Plan, PlanError, Planner, Status};
use crate::problem::{ComponentKind, Cost, CostEntry, Problem, ProblemError};
use crate::refine::Start;
use crate::system::cost_terms;

/// One point of the front.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct ParetoPoint {
    /// Factor κ on the base's weights.
    pub factor: f64,
    /// Base motion B, without the factor.
    pub base: f64,
    /// Joint effort E.
    pub joints: f64,
    /// The plan.
    pub plan: Plan,
}

impl ParetoPoint {
    /// κB + E.
    fn scalarised(&self, factor: f64) -> f64 {
        factor * self.base + self.joints
    }
}

/// A sweep over the factor.
#[derive(Debug)]
pub struct ParetoFront<'a> {
    problem: &'a Problem,
    planner: Planner,
    points: Vec<ParetoPoint>,
}

/// Relative gain for which a point is planned again from a neighbour's motion.
const GAIN: f64 = 1e-6;

impl<'a> ParetoFront<'a> {
    /// The front of `problem`, whose cost should have weights on both sides, see [`balanced`].
    pub fn new(problem: &'a Problem) -> Self {
        Self {
            problem,
            planner: Planner::new(),
            points: Vec::new(),
        }
    }

    /// The points found so far, in the order of their factors.
    pub fn points(&self) -> &[ParetoPoint] {
        &self.points
    }

    /// Plans for every factor in turn, each from the plan before.
    ///
    /// The problem is not convex, and a plan may stay with a motion that another has become better
    /// than. Where a neighbour's motion has the lower cost at a point's own factor, the point is
    /// planned again from there. Where the monitor stops it, the points until then stay.
    ///
    /// # Errors
    /// [`PlanError`] as of [`Planner::plan_with`].
    pub fn sweep(
        &mut self,
        factors: &[f64],
        monitor: &mut dyn FnMut(f64, &Event<'_>) -> Control,
    ) -> Result<(), PlanError> {
        for &factor in factors {
            let point = self.plan(factor, self.points.len().checked_sub(1), monitor)?;
            let stopped = point.plan.status == Status::Interrupted;
            self.points.push(point);
            if stopped {
                return Ok(());
            }
        }
        let count = self.points.len();
        // Down, then up: a better motion may serve several points in a row.
        let pairs = (1..count)
            .rev()
            .map(|k| (k - 1, k))
            .chain((1..count).map(|k| (k, k - 1)));
        for (k, neighbour) in pairs {
            let [own, other] = [k, neighbour].map(|i| &self.points[i]);
            let factor = own.factor;
            let better = other.scalarised(factor) < own.scalarised(factor) * (1.0 - GAIN);
            let usable = other.plan.status == Status::Solved;
            if usable && (better || own.plan.status != Status::Solved) {
                let point = self.plan(factor, Some(neighbour), monitor)?;
                if point.plan.status == Status::Interrupted {
                    return Ok(());
                }
                let gained = point.scalarised(factor) < self.points[k].scalarised(factor);
                let solved = |point: &ParetoPoint| point.plan.status == Status::Solved;
                if solved(&point) && (gained || !solved(&self.points[k])) {
                    self.points[k] = point;
                }
            }
        }
        Ok(())
    }

    fn plan(
        &mut self,
        factor: f64,
        from: Option<usize>,
        monitor: &mut dyn FnMut(f64, &Event<'_>) -> Control,
    ) -> Result<ParetoPoint, PlanError> {
        let problem = scaled(self.problem, factor)?;
        let usable = |status| status == Status::Solved || status == Status::NotConverged;
        let start = from
            .map(|k| &self.points[k].plan)
            .filter(|plan| usable(plan.status))
            .map(|plan| Start {
                trajectory: plan.discretization.clone(),
                iterate: Some(plan.iterate.clone()),
            });
        let plan = self
            .planner
            .plan_with(&problem, start.as_ref(), &mut |event| {
                monitor(factor, event)
            })?;
        let terms = cost_terms(self.problem, &plan.discretization);
        Ok(ParetoPoint {
            factor,
            base: terms.base(),
            joints: terms.joints(),
            plan,
        })
    }
}

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
fn scaled(problem: &Problem, factor: f64) -> Result<Problem, ProblemError> {
    let angles = problem.component_count(ComponentKind::BaseRate);
    problem.edited(|problem| {
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
