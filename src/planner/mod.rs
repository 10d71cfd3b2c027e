//! Planners: from a [`Problem`](crate::problem::Problem) to a [`Plan`].

mod collocation;
mod conditioning;
mod dispatch;
mod doubt;
mod error;
mod event;
pub mod floor;
mod instability;
mod joint_space;
mod method;
mod plan;
mod verification;
mod words;

pub use crate::refine::Start;
pub use collocation::{BASE_RATE_REGULARIZATION, Planner, on_first_mesh, plan};
pub(crate) use collocation::{first_mesh, led_within};
pub use conditioning::Conditioning;
pub use doubt::Doubt;
pub use error::PlanError;
pub use event::Event;
pub use instability::Instability;
pub use joint_space::matpm_motion;
pub use method::Method;
pub use plan::{Diagnosis, LimitFinding, Plan, StartCounts, Status, Timing};
pub use verification::{Judgement, judge, judge_solved};
