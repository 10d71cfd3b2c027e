//! Finer meshes for the best that starts ended at.

use super::event::SearchEvent;
use super::optimum::Ended;
use super::teller::Teller;
use crate::nlp::Deadline;
use crate::parallel;
use crate::planner::floor::LowerBounds;
use crate::planner::{Event, Plan, PlanError, Planner, Status};
use crate::problem::Problem;

/// Part by which J may be less on finer meshes than on the first; of what was seen, 12 % were most.
const COARSE: f64 = 0.25;

/// One of the best with its refined plan.
pub(super) struct Refined {
    pub ended: Ended,
    pub plan: Plan,
}

/// What refining came to.
pub(super) struct Refinements {
    pub refined: Vec<Refined>,
    /// Those too far above the refined ones on the first mesh.
    pub others: Vec<Ended>,
    /// What no motion can do better than; for planar arms with two joints.
    pub bounds: Option<LowerBounds>,
}

/// Refines within the time that is left.
pub(super) struct Refining<'a> {
    pub problem: &'a Problem,
    pub deadline: Deadline,
    pub teller: &'a Teller<'a>,
}

/// What runs beside others.
enum Piece {
    Plan(Box<Result<Plan, PlanError>>),
    Bounds(Option<LowerBounds>),
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
        let least = best
            .first()
            .map_or(f64::INFINITY, |one| one.optimum.objective);
        let (first, others): (_, Vec<Ended>) =
            best.into_iter().partition(|one| may_reach(one, least));
        let (mut refined, bounds) = self.with_bounds(first)?;
        let solved = refined
            .iter()
            .filter(|one| one.plan.status == Status::Solved);
        let costs = solved.map(|one| one.plan.objective);
        let least = costs.fold(f64::INFINITY, f64::min);
        let (second, others) = others.into_iter().partition(|one| may_reach(one, least));
        refined.extend(self.each(second)?);
        Ok(Refinements {
            refined,
            others,
            bounds,
        })
    }

    /// Refines each of `best`, several at a time.
    pub fn each(&self, best: Vec<Ended>) -> Result<Vec<Refined>, PlanError> {
        let of = best.len();
        let plans = parallel::map_sharing(of, &|index| self.plan(&best[index], index + 1, of));
        paired(best, plans)
    }

    /// The same, with the bounds beside them.
    fn with_bounds(
        &self,
        best: Vec<Ended>,
    ) -> Result<(Vec<Refined>, Option<LowerBounds>), PlanError> {
        let Some(first) = best.first() else {
            return Ok((Vec::new(), None));
        };
        let (of, found) = (best.len(), first.optimum.max_base_attitude);
        let mut bounds = None;
        let mut plans = Vec::with_capacity(of);
        let pieces = parallel::map_sharing(of + 1, &|index| match best.get(index) {
            Some(ended) => Piece::Plan(Box::new(self.plan(ended, index + 1, of))),
            None => Piece::Bounds(LowerBounds::new(self.problem, found, self.deadline)),
        });
        for piece in pieces {
            match piece {
                Piece::Plan(plan) => plans.push(*plan),
                Piece::Bounds(found) => bounds = found,
            }
        }
        Ok((paired(best, plans)?, bounds))
    }

    /// The plan that `ended` comes to.
    fn plan(&self, ended: &Ended, candidate: usize, of: usize) -> Result<Plan, PlanError> {
        let problem = self.in_time()?;
        let mut monitor = |&event: &Event<'_>| {
            self.teller.tell(&SearchEvent::Refining {
                candidate,
                of,
                event,
            })
        };
        let mut planner = Planner::new().without_diagnosis();
        planner.plan_with(&problem, Some(&ended.start), &mut monitor)
    }
}

/// Whether `one` may be refined to a J of at most `least`.
fn may_reach(one: &Ended, least: f64) -> bool {
    let cost = one.optimum.objective;
    one.gross || cost - COARSE * cost.abs() <= least
}

/// Each of `best` with its plan.
///
/// # Errors
/// The first there is.
fn paired(
    best: Vec<Ended>,
    plans: Vec<Result<Plan, PlanError>>,
) -> Result<Vec<Refined>, PlanError> {
    let pairs = best.into_iter().zip(plans);
    pairs
        .map(|(ended, plan)| plan.map(|plan| Refined { ended, plan }))
        .collect()
}
