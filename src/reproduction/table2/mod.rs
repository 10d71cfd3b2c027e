//! Table II, the sensitivity to the constants of the law, and a sweep of the control's weight.

mod measure;
mod rows;
mod sensitivity;
mod sweep;

pub use measure::Measured;
pub use rows::{Published, Row, markdown, rows, sheet};
pub use sensitivity::{SensitivityRow, sensitivity, sensitivity_markdown, sensitivity_sheet};
pub use sweep::{SweepRow, faster, pays, sweep, sweep_figure, sweep_markdown, sweep_sheet};
