//! Plans by the adaptive or the global Radau pseudospectral method.

mod base_rate;
mod bound_warnings;
pub(super) mod diagnosis;
mod elastic_start;
mod elastic_trajectory;
mod first_mesh;
mod planner;
mod retarget;
mod sparsity_cache;
mod warnings;

pub use base_rate::REGULARIZATION as BASE_RATE_REGULARIZATION;
pub use first_mesh::on_first_mesh;
pub use planner::{Planner, plan};

pub(super) use base_rate::plan as plan_base_rate;
pub(crate) use elastic_start::led_within;
pub(crate) use first_mesh::first_mesh;
