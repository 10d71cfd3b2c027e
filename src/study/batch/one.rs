//! A single row of a batch.

use super::{Figures, Motion, Record, Refusal, RowStatus, Task, Tasks};
use crate::nlp::Control;
use crate::nlp::ipopt::interrupt;
use crate::planner::{Event, Method, Plan, PlanError, Planner, Start, Status};
use crate::text::printable::one_line;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// Longest reason, characters.
const LONGEST: usize = 1_000;

/// Plans rows one after another, and keeps what they share.
///
/// A plan is that of [`Planner::plan_by`] with a planner of its own, bit for bit, re-integrated by
/// [`Plan::verify`].
#[derive(Debug, Default)]
pub struct RowPlanner {
    planner: Planner,
    start: Option<Start>,
    motions: bool,
}

impl RowPlanner {
    /// One that begins every plan at `start`, where there is one, and keeps the planned motions in its
    /// records where it is asked to.
    pub fn new(start: Option<Start>, motions: bool) -> Self {
        Self {
            planner: Planner::new(),
            start,
            motions,
        }
    }

    /// Plans the row at `position`. Whatever goes wrong, a panic included, is in its record.
    pub fn plan<T: Tasks + ?Sized>(&mut self, tasks: &T, position: u64) -> Record {
        self.plan_until(tasks, position, &|| false)
    }

    /// As [`RowPlanner::plan`], but ends as interrupted once `stopped` holds, which is asked after every
    /// iteration. Unlike a signal's flag it ends this plan alone.
    pub fn plan_until<T: Tasks + ?Sized>(
        &mut self,
        tasks: &T,
        position: u64,
        stopped: &dyn Fn() -> bool,
    ) -> Record {
        let began = Instant::now();
        let key = tasks.key(position);
        let lost = |status, reason: &str| {
            let reason = one_line(reason, LONGEST);
            Record::lost((position, key.clone()), status, reason, began.elapsed())
        };
        // What a panic leaves half done in the planner goes with it.
        let planned = catch_unwind(AssertUnwindSafe(|| {
            let task = tasks.task(position)?;
            let planned = plan(&mut self.planner, &task, self.start.as_ref(), stopped);
            Ok::<_, Refusal>((planned, task))
        }));
        match planned {
            Ok(Ok((Ok(plan), task))) => {
                let Task { problem, cells } = task;
                let (status, reason) = verdict(&plan, problem.solver.time_limit);
                Record {
                    name: problem.name.clone(),
                    cells,
                    figures: Some(Figures::of(&plan)),
                    motion: self.motions.then(|| Motion::of(plan.trajectory)),
                    ..lost(status, &reason)
                }
            }
            Ok(Ok((Err(error), task))) => {
                let status = match error {
                    PlanError::Problem(_) => RowStatus::Malformed,
                    _ => RowStatus::Failed,
                };
                Record {
                    name: task.problem.name.clone(),
                    cells: task.cells,
                    ..lost(status, &error.to_string())
                }
            }
            Ok(Err(refusal)) => Record {
                name: refusal.name,
                cells: refusal.cells,
                ..lost(refusal.status, &refusal.reason)
            },
            Err(payload) => {
                self.planner = Planner::new();
                lost(RowStatus::Panicked, message(payload.as_ref()))
            }
        }
    }
}

fn plan(
    planner: &mut Planner,
    task: &Task,
    start: Option<&Start>,
    stopped: &dyn Fn() -> bool,
) -> Result<Plan, PlanError> {
    let problem = &task.problem;
    let method = Method::Collocation(problem.mesh.method);
    let mut plan = planner.plan_by(method, problem, start, &mut |event| {
        // Of a signal Ipopt asks by itself.
        let signalled = matches!(event, Event::Step { .. }) && interrupt::requested();
        match signalled || stopped() {
            true => Control::Stop,
            false => Control::Continue,
        }
    })?;
    plan.verify(problem);
    Ok(plan)
}

/// How a plan ended, and why.
fn verdict(plan: &Plan, limit: Option<std::time::Duration>) -> (RowStatus, String) {
    let over = |limit| plan.timing.total >= limit;
    match (plan.status, &plan.diagnosis) {
        (Status::Solved, _) => (RowStatus::Solved, String::new()),
        (Status::NotConverged, _) if limit.is_some_and(over) => {
            (RowStatus::TimedOut, "the time limit was reached".into())
        }
        (Status::Infeasible, Some(why)) => (RowStatus::Infeasible, why.summary.clone()),
        (status, _) => {
            let last = plan.iterations.last();
            let ended = last.map(|record| record.nlp_status.describe().to_owned());
            let warnings = plan.warnings.iter().cloned();
            let reason: Vec<String> = ended.into_iter().chain(warnings).collect();
            (status.into(), reason.join("; "))
        }
    }
}

/// What a panic says.
fn message(payload: &(dyn Any + Send)) -> &str {
    let text = payload.downcast_ref::<&str>().copied();
    let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("a panic without words")
}
