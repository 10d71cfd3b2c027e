//! The nonlinear programme and its solver.
//!
//! A transcription implements [`Nlp`]. [`ipopt`] solves it with the system Ipopt and is the only safe
//! wrapper over the `ipopt-sys` bindings. [`kkt`] is the multifrontal linear solver that Ipopt is
//! given. Nothing here knows optimal control.

pub mod ipopt;
pub mod kkt;

mod iterate;
mod problem;
mod settings;
mod solution;

pub use iterate::Iterate;
pub use problem::{Nlp, Size, Undefined};
pub use settings::{OptionValue, Settings};
pub use solution::{Control, Progress, Solution, Statistics, Status};
