//! The nonlinear programme and its solver.
//!
//! [`Nlp`] is what a transcription offers; [`ipopt`] hands it to the system Ipopt and is the only
//! safe wrapper over the `ipopt-sys` bindings; [`kkt`] is the linear solver that it is given, and
//! [`threads`] says how many threads all of this may use. Nothing here knows optimal control.

pub mod ipopt;
pub mod kkt;
pub mod threads;

mod iterate;
mod problem;
mod settings;
mod solution;

pub use iterate::Iterate;
pub use problem::{Nlp, Size, Undefined};
pub use settings::{OptionValue, Settings};
pub use solution::{Control, Progress, Solution, Statistics, Status};
