//! One task by every planner.

use crate::nlp::Control;
use crate::planner::{Method, Plan, PlanError, Planner, Status};
use crate::problem::{Problem, ProblemError};
use crate::refine;
use crate::study::search::{Optima, Search, SearchEvent};

/// What one planner made of the task.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Entry {
    /// The planner.
    pub method: Method,
    /// Its plan, or why it is not made for the task.
    pub plan: Result<Plan, String>,
}

/// The planner of this program.
const ADAPTIVE: Method = Method::Collocation(refine::Method::Adaptive);

/// One task by every planner.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct Comparison {
    /// In the order of [`Method::ALL`], A-RPM first; fewer where it was interrupted.
    pub entries: Vec<Entry>,
    /// What the search of A-RPM found, where there was one.
    pub optima: Option<Optima>,
    /// What a reader should know of how the planners were asked, a sentence each.
    pub notes: Vec<String>,
}

/// What is told of every step: the planner, and the step.
type Monitor<'m> = dyn FnMut(Method, &SearchEvent<'_>) -> Control + Send + 'm;

impl Comparison {
    /// Plans `problem` by every method, each from nothing, A-RPM by `search` where there is one.
    ///
    /// Planners that know joint goals alone get the joint positions at which A-RPM ended where the
    /// task is a goal for the end effector. Where the monitor stops a plan, the entries until then
    /// stay, that plan the last of them.
    ///
    /// # Errors
    /// [`PlanError`] of a planner that optimises; a task that another planner is not made for is
    /// an entry without a plan.
    pub fn plan(
        problem: &Problem,
        search: Option<&Search>,
        monitor: &mut Monitor<'_>,
    ) -> Result<Self, PlanError> {
        let mut found = Self::default();
        let mut in_joints = Ok(problem.clone());
        for method in Method::ALL {
            if found.entries.len() == 1
                && problem.task.end_effector.is_some()
                && let Some(joints) = joints_reached(&found.entries[0])
            {
                in_joints = in_joint_space(problem, joints);
                found.notes.push(in_joint_space_note());
            }
            let task = if method.optimises() {
                Ok(problem)
            } else {
                in_joints.as_ref()
            };
            let plan = match (task, search) {
                (Ok(task), Some(search)) if method == ADAPTIVE => {
                    let problem =
                        task.edited(|problem| problem.mesh.method = refine::Method::Adaptive);
                    let told = &mut |event: &SearchEvent<'_>| monitor(method, event);
                    search.run(&problem?, None, told).map(|searched| {
                        found.optima = Some(searched.optima);
                        searched.plan
                    })
                }
                (Ok(task), _) => Planner::new().plan_by(method, task, None, &mut |&event| {
                    monitor(method, &SearchEvent::of_plan(event))
                }),
                (Err(error), _) => Err(error.clone().into()),
            };
            let plan = match plan {
                Ok(plan) => Ok(plan),
                Err(PlanError::Problem(error)) if !method.optimises() => Err(error.to_string()),
                Err(error) => return Err(error),
            };
            let stopped = matches!(&plan, Ok(plan) if plan.status == Status::Interrupted);
            found.entries.push(Entry { method, plan });
            if stopped {
                break;
            }
        }
        Ok(found)
    }

    /// The plan by one method, where there is one.
    pub fn by(&self, method: Method) -> Option<&Plan> {
        let entry = self.entries.iter().find(|entry| entry.method == method)?;
        entry.plan.as_ref().ok()
    }
}

/// The joint positions at which A-RPM ended, where it solved the task.
fn joints_reached(adaptive: &Entry) -> Option<&[f64]> {
    let plan = adaptive.plan.as_ref().ok()?;
    let last = plan.trajectory.joint_position.last()?;
    (plan.status == Status::Solved).then_some(last)
}

/// `problem` with `joints` as its goal, for the planners that know joint goals alone.
fn in_joint_space(problem: &Problem, joints: &[f64]) -> Result<Problem, ProblemError> {
    problem.edited(|problem| {
        let task = &mut problem.task;
        task.final_joints = joints.to_vec();
        task.free_joints.fill(false);
        task.end_effector = None;
    })
}

fn in_joint_space_note() -> String {
    format!(
        "The task is a goal for the end effector. Planners in joint space were given the joint \
         positions at which {} ends; with another base motion they leave the end effector \
         elsewhere.",
        ADAPTIVE.name()
    )
}
