//! A planning problem: robot, task, limits, cost and mesh, eq. (7) to (18).

mod builder;
mod components;
mod cost;
mod error;
mod goal;
mod impossible;
mod keep_out;
mod limit_id;
mod limits;
mod magnitude;
mod momentum;
mod preset;
mod task;
mod unit;
mod valid;
mod validation;
mod way_point;

pub use builder::ProblemBuilder;
pub use components::ComponentKind;
pub use cost::{Cost, CostEntry, CostId};
pub use error::ProblemError;
pub use goal::{EndEffectorGoal, GoalFrame};
pub use impossible::{Impossible, Place};
pub use keep_out::{KeepOut, Shape, Solid};
pub use limit_id::LimitId;
pub use limits::{LimitEntry, Limits};
pub use momentum::Momentum;
pub use preset::{Preset, Sizes};
pub use task::Task;
pub use unit::Unit;
pub use valid::Problem;
pub use way_point::{Moment, WayPoint};

pub(crate) use validation::{EXPECTED_NAME, check_pair, is_name};
