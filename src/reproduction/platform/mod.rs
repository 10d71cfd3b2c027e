//! The ground platform of Section IV.B, as far as a model of it can speak to the measurements.

mod base_inertia;
mod fit;
mod play;
mod report;

pub use base_inertia::BaseInertia;
pub use fit::fit;
pub use play::{Played, played};
pub use report::Platform;
