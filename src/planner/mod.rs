//! Planners: from a [`Problem`] to a [`Plan`].

mod diagnosis;
mod event;
mod free_floating;
mod goal;
mod guess;
mod keep_out;
mod momentum;
mod plan;
mod problem;
mod radau;
mod replan;
mod straight_line;
mod trajectory;
mod turn;

pub use crate::refine::Start;
pub use event::Event;
pub use free_floating::FreeFloating;
pub use goal::{EndEffectorGoal, GoalFrame};
pub use keep_out::{KeepOut, Obstacle, Sphere};
pub use momentum::Momentum;
pub use plan::{Diagnosis, LimitFinding, Metrics, Plan, Status, Timing, Trajectory};
pub use problem::{Cost, Limits, Problem, ProblemError, Task};
pub use radau::{PlanError, Planner, plan};
pub use straight_line::{StraightLine, straight_line};
