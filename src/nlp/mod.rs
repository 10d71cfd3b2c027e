//! The nonlinear programme and its solver.
//!
//! A transcription implements [`Nlp`]. [`ipopt`] solves it with the system Ipopt and is the only safe
//! wrapper over the `ipopt-sys` bindings. [`kkt`] is the multifrontal linear solver that Ipopt is
//! given. Nothing here knows optimal control.

#![warn(missing_debug_implementations)]

pub mod ipopt;
pub mod kkt;

mod deadline;
mod iterate;
mod linear_solver;
mod problem;
mod scaled;
mod settings;
mod solution;

pub use deadline::Deadline;
pub use iterate::Iterate;
pub use linear_solver::LinearSolver;
pub use problem::{Nlp, Size, Undefined};
pub use scaled::{Scaled, Units};
pub use settings::{OptionValue, Settings};
pub use solution::{Control, Evaluations, HandOver, Progress, Solution, Statistics, Status};

#[cfg(test)]
mod tests {
    use super::ipopt::{IpoptError, KktSystem};
    use super::kkt::{Factors, Inertia, NotFinite, Pattern, PatternError, Symbolic};
    use super::*;

    #[test]
    fn public_types_go_from_thread_to_thread() {
        fn is_send_and_sync<T: Send + Sync + 'static>() {}
        is_send_and_sync::<Control>();
        is_send_and_sync::<Evaluations>();
        is_send_and_sync::<HandOver>();
        is_send_and_sync::<Iterate>();
        is_send_and_sync::<LinearSolver>();
        is_send_and_sync::<OptionValue>();
        is_send_and_sync::<Progress>();
        is_send_and_sync::<Settings>();
        is_send_and_sync::<Size>();
        is_send_and_sync::<Solution>();
        is_send_and_sync::<Statistics>();
        is_send_and_sync::<Status>();
        is_send_and_sync::<Undefined>();
        is_send_and_sync::<IpoptError>();
        is_send_and_sync::<KktSystem>();
        is_send_and_sync::<Factors>();
        is_send_and_sync::<Inertia>();
        is_send_and_sync::<NotFinite>();
        is_send_and_sync::<Pattern>();
        is_send_and_sync::<PatternError>();
        is_send_and_sync::<Symbolic>();
    }
}
