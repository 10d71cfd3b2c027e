//! The system Ipopt behind one safe function, [`solve`].
//!
//! This is the only place that talks to the C interface. Ipopt prints nothing unless asked,
//! reads no `ipopt.opt` from the working directory, and is given one solve at a time where its
//! linear solver needs that. A panic in a [`Nlp`] or a monitor does not cross C: it is resumed
//! once Ipopt has returned.

mod callbacks;
mod choice;
mod error;
mod input;
pub mod interrupt;
mod options;
mod ours;
mod probe;
mod problem;
mod serial;
mod status;
mod structure;
mod timing;

pub use choice::{linear_solver, why_not_ours};
pub use error::IpoptError;
pub use ours::{System, record};
pub use probe::linear_solvers;
pub use serial::serialised;

use super::{Control, Iterate, Nlp, Progress, Settings, Size, Solution, Statistics, Status};
use callbacks::Context;
use choice::Choice;
use ours::Session;
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
/// Where our own linear solver fails, the solve is begun again with MUMPS, and
/// [`Statistics::fallbacks`] says so.
///
/// The time of [`Statistics::linear_solver`] is measured where the solver is our own; otherwise it
/// is a sum of Ipopt's figures, which have a resolution of 1 ms. [`Statistics::total`] does not
/// contain the wait for another thread's solve.
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
    let choice = Choice::of(settings)?;
    let mut attempt = Attempt {
        nlp,
        settings,
        start,
        size,
        bounds,
        structure,
    };
    let (solution, failure) = attempt.run(&choice, monitor)?;
    let hopeless =
        failure.is_none() || solution.status.is_solved() || solution.status == Status::Interrupted;
    if hopeless {
        return Ok(solution);
    }
    // Our linear solver could not serve: once more from the start, by what stands in.
    let (mut second, _) = attempt.run(&Choice::fallback(), monitor)?;
    second.statistics.derivatives += solution.statistics.derivatives;
    second.statistics.linear_solver += solution.statistics.linear_solver;
    second.statistics.total += solution.statistics.total;
    second.statistics.fallbacks = 1;
    Ok(second)
}

/// What the attempts at one solve share.
struct Attempt<'a, N: Nlp + ?Sized> {
    nlp: &'a mut N,
    settings: &'a Settings,
    start: &'a Iterate,
    size: Size,
    bounds: input::Bounds,
    structure: structure::Structures,
}

impl<N: Nlp + ?Sized> Attempt<'_, N> {
    /// One attempt, and why our linear solver could not serve where it could not.
    fn run(
        &mut self,
        choice: &Choice,
        monitor: &mut dyn FnMut(&Progress) -> Control,
    ) -> Result<(Solution, Option<String>), IpoptError> {
        let turn = serial::turn(&choice.name)?;
        let begin = Instant::now();
        let session = Session::begin(choice.real);
        let mut problem = Problem::create(self.size, &mut self.bounds)?;
        options::apply(&mut problem, self.settings, choice)?;
        let ours = choice.ours.is_some();
        let timing = if self.settings.timing && !ours {
            TimingFile::attach(&mut problem)
        } else {
            None
        };

        let warm = self.settings.warm_start.is_some();
        let mut iterate = input::initial(self.start, self.size, warm);
        let mut constraints = vec![f64::NAN; self.size.constraints];
        let mut objective = f64::NAN;
        let mut context = Context::new(&mut *self.nlp, monitor, &self.structure);
        let code = problem.solve(&mut iterate, &mut constraints, &mut objective, &mut context);
        let record = context.finish();
        // Ipopt closes the timing file and frees the linear solver only with the problem.
        drop(problem);
        let counted = session.end();
        let linear_time = if ours && self.settings.timing {
            counted.time
        } else {
            timing.and_then(TimingFile::read).unwrap_or_default()
        };
        let total = begin.elapsed();
        drop(turn);

        if let Some(payload) = record.panic {
            resume_unwind(payload);
        }
        let status = status::grade(code, &choice.name)?;
        let last = record.last;
        let failure = counted.failure.or_else(|| {
            (ours && code == ipopt_sys::Error_In_Step_Computation)
                .then(|| "no step could be computed with it".into())
        });
        let solution = Solution {
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
                fallbacks: 0,
                total,
            },
        };
        Ok((solution, failure))
    }
}
