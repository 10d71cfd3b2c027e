//! Finer meshes for the best that starts ended at.

use super::event::SearchEvent;
use super::optimum::{Ended, Optimum, alike};
use super::rivals::{Rivals, is_better};
use super::teller::Teller;
use crate::nlp::{Control, Deadline};
use crate::parallel;
use crate::planner::{Event, Plan, PlanError, Planner, Status};
use crate::problem::Problem;
use crate::refine;

/// Part by which J may be less on finer meshes than on the first; of what was seen, 12 % were most.
const COARSE: f64 = 0.25;

/// One of the best with its plan.
pub(super) struct Refined {
    pub ended: Ended,
    pub plan: Plan,
    /// J on the mesh where it was left for others that are better or the same.
    left_at: Option<f64>,
}

/// What refining came to.
#[derive(Default)]
pub(super) struct Refinements {
    /// Those that were refined to the end.
    pub refined: Vec<Refined>,
    /// Those that were left on the way.
    pub left: Vec<Refined>,
    /// Those too far above the refined ones on the first mesh.
    pub others: Vec<Ended>,
}

/// Refines within the time that is left.
pub(super) struct Refining<'a> {
    pub problem: &'a Problem,
    pub deadline: Deadline,
    pub teller: &'a Teller<'a>,
}

impl Refining<'_> {
    /// The problem with the time that is left.
    pub fn in_time(&self) -> Result<Problem, PlanError> {
        let left = self.deadline.remaining();
        let edited = self
            .problem
            .edited(|problem| problem.solver.time_limit = left);
        edited.map_err(PlanError::from)
    }

    /// Refines those of `best` that may come to less than the others: first by J on the first mesh, then
    /// by what the refined ones came to.
    pub fn hopeful(&self, best: Vec<Ended>) -> Result<Refinements, PlanError> {
        let mut all = Refinements {
            others: best,
            ..Refinements::default()
        };
        let first = all.others.first();
        let mut least = first.map_or(f64::INFINITY, |one| one.optimum.objective);
        loop {
            let known = all.least();
            let (mut hopeful, others): (Vec<_>, _) = all
                .others
                .into_iter()
                .partition(|one| may_reach(one, least));
            all.others = others;
            // What was better on the way may not have converged.
            let is_hopeful = |one: &Refined| one.left_at.is_some_and(|cost| is_better(cost, known));
            let (again, left): (Vec<_>, _) = all.left.into_iter().partition(is_hopeful);
            all.left = left;
            hopeful.extend(again.into_iter().map(|one| one.ended));
            // Where it was stopped, the best is its first mesh alone.
            if hopeful.is_empty() || self.teller.has_stopped() && !all.refined.is_empty() {
                all.others.extend(hopeful);
                return Ok(all);
            }
            let (left, refined) = self.compete(hopeful, known)?;
            all.left.extend(left);
            all.refined.extend(refined);
            least = all.least();
        }
    }

    /// Refines `one` whatever it comes to.
    pub fn alone(&self, one: &Ended) -> Result<Plan, PlanError> {
        let (plan, _) = self.plan(one, (1, 1), &mut |_| true)?;
        Ok(plan)
    }

    /// Refines each of `best`, several at a time, and leaves on their second mesh those that are no better
    /// than `least` or an earlier one, but [default](Ended::is_default) ones only where they are worse;
    /// those that were left come first.
    fn compete(
        &self,
        best: Vec<Ended>,
        least: f64,
    ) -> Result<(Vec<Refined>, Vec<Refined>), PlanError> {
        let of = best.len();
        let rivals = Rivals::new(of, least);
        let mut plans = parallel::map_sharing(of, &|_| {
            let mut rival = rivals.begin_next();
            let index = rival.index();
            let is_default = best[index].is_default();
            let mut goes_on = |cost| rival.goes_on(cost, is_default);
            let plan = self.plan(&best[index], (index + 1, of), &mut goes_on);
            if let Ok((plan, None)) = &plan
                && plan.status == Status::Solved
            {
                rival.tell(plan.objective);
            }
            (index, plan)
        });
        plans.sort_by_key(|(index, _)| *index);
        let refined = best.into_iter().zip(plans).map(|(ended, (_, plan))| {
            plan.map(|(plan, left_at)| Refined {
                ended,
                plan,
                left_at,
            })
        });
        let refined: Vec<Refined> = refined.collect::<Result<_, PlanError>>()?;
        Ok(refined.into_iter().partition(|one| one.left_at.is_some()))
    }

    /// The plan that `ended` comes to, and its J on the mesh where it does not go on.
    fn plan(
        &self,
        ended: &Ended,
        (candidate, of): (usize, usize),
        goes_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<(Plan, Option<f64>), PlanError> {
        let problem = self.in_time()?;
        let mut left_at = None;
        let mut first_error = None;
        let mut monitor = |&event: &Event<'_>| {
            let told = SearchEvent::Refining {
                candidate,
                of,
                event,
            };
            if self.teller.tell(&told) == Control::Stop {
                return Control::Stop;
            }
            if let Event::Refinement(refine::Event::Solved(record)) = event
                && record.nlp_status.is_solved()
            {
                let first = *first_error.get_or_insert(record.max_error);
                let says_more = record.max_error < first && !record.verdict.is_converged();
                if says_more && !goes_on(record.objective) {
                    left_at = Some(record.objective);
                    return Control::Stop;
                }
            }
            Control::Continue
        };
        let mut planner = Planner::new().without_diagnosis();
        let plan = planner.plan_with(&problem, Some(&ended.start), &mut monitor)?;
        Ok((plan, left_at))
    }
}

impl Refined {
    /// What it came to.
    pub fn optimum(&self) -> Optimum {
        let plan = &self.plan;
        Optimum {
            objective: plan.objective,
            max_base_attitude: plan.metrics.max_base_attitude,
            final_base_attitude: plan.metrics.final_base_attitude,
            status: Some(plan.status),
            ..self.ended.optimum.clone()
        }
    }

    /// Whether it would have come to `other`, though it was left on the way.
    pub fn is_alike(&self, other: &Optimum) -> bool {
        alike(&self.optimum(), other)
    }
}

impl Refinements {
    /// The least J of those that were solved.
    fn least(&self) -> f64 {
        let solved = |one: &&Refined| one.plan.status == Status::Solved;
        let costs = self.refined.iter().filter(solved);
        costs.fold(f64::INFINITY, |least, one| least.min(one.plan.objective))
    }
}

/// Whether `one` may be refined to a J of at most `least`.
fn may_reach(one: &Ended, least: f64) -> bool {
    let cost = one.optimum.objective;
    one.gross || cost - COARSE * cost.abs() <= least
}
