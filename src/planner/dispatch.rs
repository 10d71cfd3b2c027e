//! One way to call any of the planners.

use super::collocation::plan_base_rate;
use super::joint_space::{acceleration_qp, matpm, reaction_null_space, straight_line};
use super::{Event, Method, Plan, PlanError, Planner};
use crate::nlp::Control;
use crate::problem::Problem;
use crate::refine::Start;

impl Planner {
    /// Plans `problem` by `method`, whatever method the problem's mesh names.
    ///
    /// A start serves the methods that optimise; the others have no use for one.
    ///
    /// # Errors
    /// [`PlanError`], a task that the method is not made for included; an infeasible or
    /// unconverged problem is no error but a [`Status`](super::Status).
    pub fn plan_by(
        &mut self,
        method: Method,
        problem: &Problem,
        start: Option<&Start>,
        monitor: &mut dyn FnMut(&Event<'_>) -> Control,
    ) -> Result<Plan, PlanError> {
        let plan = match method {
            Method::Collocation(method) if problem.mesh.method == method => {
                self.plan_with(problem, start, monitor)
            }
            Method::Collocation(method) => {
                let problem = problem.edited(|problem| problem.mesh.method = method)?;
                self.plan_with(&problem, start, monitor)
            }
            Method::BaseRate => plan_base_rate(self, problem, start, monitor),
            Method::Matpm => matpm::plan(problem),
            Method::StraightLine => straight_line::plan(problem),
            Method::ReactionNullSpace => reaction_null_space::plan(problem),
            Method::AccelerationQp => acceleration_qp::plan(problem, monitor),
        };
        plan.map(Plan::judged_finite)
    }
}
