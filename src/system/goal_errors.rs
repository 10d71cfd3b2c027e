//! How near the end effector came to its goals.

use super::dispatch::{System, with_system};
use super::free_floating::FreeFloating;
use super::rows::EndEffectorRows;
use crate::dynamics::space::Space;
use crate::problem::Problem;
use crate::transcription::Discretization;

/// A goal for the end effector, and how near it was met.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct GoalError {
    /// Key in the problem file: `task.final.end_effector`, `task.way_points[0].end_effector`.
    pub key: String,
    /// When, s.
    pub t: f64,
    /// Distance from the position asked for, m; `None` where none was.
    pub distance: Option<f64>,
    /// Angle from the orientation asked for, rad; `None` where none was.
    pub angle: Option<f64>,
}

/// Every goal of `problem` for the end effector, in the order of time, as `plan` meets it.
pub fn goal_errors(problem: &Problem, plan: &Discretization) -> Vec<GoalError> {
    with_system!(&System::new(problem), system => goal_errors_in(system, plan))
}

pub(crate) fn goal_errors_in<Sp: Space>(
    system: &FreeFloating<Sp>,
    plan: &Discretization,
) -> Vec<GoalError> {
    let mut x = vec![0.0; plan.states];
    let mut u = vec![0.0; plan.controls];
    let mut gap = |key: String, goal: &EndEffectorRows<Sp>, fraction: f64| {
        plan.at_fraction(fraction, &mut x, &mut u);
        let t = fraction * plan.duration;
        let rows = system.goal_values(goal, &x, t);
        let (distance, angle) = goal.gap(&rows);
        GoalError {
            key,
            t,
            distance,
            angle,
        }
    };
    let mut found: Vec<GoalError> = system
        .way_point_goals()
        .map(|(w, fraction, goal)| {
            gap(format!("task.way_points[{w}].end_effector"), goal, fraction)
        })
        .collect();
    if let Some(goal) = system.final_goal() {
        found.push(gap("task.final.end_effector".into(), goal, 1.0));
    }
    found
}
