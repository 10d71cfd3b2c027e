//! The ground platform of Section IV.B, as far as a model of it can speak to the measurements.

mod fit;

pub use fit::fit;
