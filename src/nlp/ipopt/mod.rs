//! The system Ipopt behind one safe function, [`solve`].
//!
//! This is the only place that talks to the C interface. Ipopt prints nothing unless asked,
//! reads no `ipopt.opt` from the working directory, and is given one solve at a time where its
//! linear solver needs that. A panic in a [`Nlp`] or a monitor does not cross C: it is resumed
//! once Ipopt has returned.

mod callbacks;
mod error;
mod input;
pub mod interrupt;
mod options;
mod probe;
mod problem;
mod serial;
mod status;
mod structure;
mod timing;

pub use error::IpoptError;
pub use probe::linear_solvers;
pub use serial::serialised;

use super::{Control, Iterate, Nlp, Progress, Settings, Solution, Statistics};
use callbacks::Context;
use problem::Problem;
use std::panic::resume_unwind;
use std::time::Instant;
use timing::TimingFile;

/// Version of the Ipopt this was built against, such as `3.11.9`.
pub fn version() -> &'static str {
    ipopt_sys::VERSION
}

/// Solves `nlp` from `start`, asking `monitor` after each iteration whether to go on.
///
/// Returns the last iterate whatever the status; the status says what it is worth. Where the
/// status means that there was no iterate at all, `x` is the start, and objective and constraint
/// values are NaN. Multipliers of the start are used only for a warm start.
///
/// Ipopt relaxes each bound b by 1e-8 max(1, |b|) (its option `bound_relax_factor`), and the result
/// may lie that far outside.
///
/// The time of [`Statistics::linear_solver`] is a sum of Ipopt's own figures, which have a
/// resolution of 1 ms. [`Statistics::total`] does not contain the wait for another thread's solve.
///
/// # Errors
/// [`IpoptError`] where the solve could not begin: a start, bounds, structure or option that
/// cannot be used.
///
/// # Panics
/// A panic in `nlp` or `monitor` is resumed with its own payload after Ipopt has returned.
pub fn solve<N: Nlp + ?Sized>(
    nlp: &mut N,
    settings: &Settings,
    start: &Iterate,
    monitor: &mut dyn FnMut(&Progress) -> Control,
) -> Result<Solution, IpoptError> {
    let size = nlp.size();
    input::check_start(nlp, size, settings, start)?;
    let bounds = input::Bounds::of(nlp, size)?;
    let structure = structure::Structures::of(nlp, size)?;
    let linear_solver = options::linear_solver(settings);
    let turn = serial::turn(&linear_solver)?;

    let begin = Instant::now();
    let mut problem = Problem::create(size, bounds)?;
    options::apply(&mut problem, settings, &linear_solver)?;
    let timing = if settings.timing {
        TimingFile::attach(&mut problem)
    } else {
        None
    };

    let mut iterate = input::initial(start, size, settings.warm_start.is_some());
    let mut constraints = vec![f64::NAN; size.constraints];
    let mut objective = f64::NAN;
    let mut context = Context::new(nlp, monitor, &structure);
    let code = problem.solve(&mut iterate, &mut constraints, &mut objective, &mut context);
    let record = context.finish();
    // Ipopt closes the timing file only with the problem.
    drop(problem);
    let linear_time = timing.and_then(TimingFile::read).unwrap_or_default();
    let total = begin.elapsed();
    drop(turn);

    if let Some(payload) = record.panic {
        resume_unwind(payload);
    }
    let status = status::grade(code, &linear_solver)?;
    let last = record.last;
    Ok(Solution {
        status,
        objective,
        iterate,
        constraints,
        statistics: Statistics {
            iterations: last.map_or(0, |last| last.iteration),
            barrier: last.map_or(f64::NAN, |last| last.barrier),
            primal_infeasibility: last.map_or(f64::NAN, |last| last.primal_infeasibility),
            dual_infeasibility: last.map_or(f64::NAN, |last| last.dual_infeasibility),
            evaluations: record.evaluations,
            derivatives: record.derivatives,
            // Rounding to 1 ms may make the parts exceed the whole.
            linear_solver: linear_time.min(total.saturating_sub(record.derivatives)),
            total,
        },
    })
}
