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
mod ma97_bridge;
mod option_access;
mod options;
mod probe;
mod problem;
mod serial;
mod status;
mod structure;
mod timing;
mod trouble;

pub use choice::{linear_solver, why_not_multifrontal};
pub use error::IpoptError;
pub use ma97_bridge::{KktSystem, record};
pub use option_access::{OptionAccess, access_of_option, access_of_solver};
pub use probe::linear_solvers;
pub use serial::serialised;

pub use ipopt_sys::usage::read_by_tick;

use super::{
    Control, Deadline, HandOver, Iterate, Nlp, Progress, Settings, Size, Solution, Statistics,
    Status,
};
use callbacks::Context;
use choice::Choice;
use ma97_bridge::Session;
use problem::Problem;
use std::panic::resume_unwind;
use std::time::Instant;
use timing::TimingFile;
use trouble::Trouble;

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
/// Where the multifrontal linear solver fails, or meets singular systems or delayed pivots on and on,
/// MUMPS takes the solve over, within its limits on iterations and time ([`HandOver`] says from
/// where). [`Statistics::fallbacks`] is then 1; counts and times are those of both attempts together.
///
/// The time of [`Statistics::linear_solver`] is measured where the solver is the multifrontal one;
/// otherwise it is a sum of Ipopt's figures, which have a resolution of 1 ms. [`Statistics::total`] does not
/// contain the wait for another thread's solve.
///
/// # Errors
/// [`IpoptError`] where the solve could not begin: a start, bounds, structure or option that
/// cannot be used.
///
/// # Panics
/// A panic in `nlp` or `monitor` is resumed with its own payload after Ipopt has returned.
pub fn solve(
    nlp: &mut dyn Nlp,
    settings: &Settings,
    start: &Iterate,
    monitor: &mut dyn FnMut(&Progress) -> Control,
) -> Result<Solution, IpoptError> {
    let size = nlp.size();
    input::check_start(nlp, size, settings, start)?;
    let bounds = input::Bounds::of(nlp, size)?;
    structure::check(nlp, size)?;
    let choice = Choice::of(settings)?;
    let mut attempt = Attempt {
        nlp,
        size,
        bounds: Some(bounds),
        deadline: Deadline::after(settings.time_limit),
    };
    let (mut first, hand_over) = attempt.run(&choice, settings, start, monitor)?;
    let Some(hand_over) = hand_over else {
        return Ok(first);
    };
    let left = settings
        .max_iterations
        .saturating_sub(first.statistics.iterations);
    if left == 0 {
        first.status = Status::MaxIterations;
        return Ok(first);
    }
    let mut settings = settings.clone();
    settings.max_iterations = left;
    let start = match hand_over.from_here {
        true => {
            settings.warm_start = Some(first.statistics.barrier);
            &first.iterate
        }
        false => start,
    };
    let (second, _) = attempt.run(&Choice::fallback(), &settings, start, monitor)?;
    let mut statistics = first.statistics;
    statistics.add(&second.statistics);
    // Two attempts at one solve.
    statistics.taken_over(hand_over.why);
    Ok(Solution {
        statistics,
        ..second
    })
}

/// How a solve is handed over to MUMPS.
#[derive(Debug, Clone, Copy)]
struct Handing {
    why: HandOver,
    /// Whether MUMPS goes on from the last iterate; else it begins again.
    from_here: bool,
}

/// What the attempts at one solve share.
struct Attempt<'a> {
    nlp: &'a mut dyn Nlp,
    size: Size,
    /// Bounds for the first attempt.
    bounds: Option<input::Bounds>,
    deadline: Deadline,
}

impl Attempt<'_> {
    /// One attempt, and how MUMPS is to take it over.
    fn run(
        &mut self,
        choice: &Choice,
        settings: &Settings,
        start: &Iterate,
        monitor: &mut dyn FnMut(&Progress) -> Control,
    ) -> Result<(Solution, Option<Handing>), IpoptError> {
        let permit = serial::permit(&choice.solver)?;
        let begin = Instant::now();
        let session = Session::begin(choice.hsl);
        let mut bounds = match self.bounds.take() {
            Some(bounds) => bounds,
            None => input::Bounds::of(&*self.nlp, self.size)?,
        };
        let mut problem = Problem::create(self.size, &mut bounds)?;
        // Ipopt has copied them.
        drop(bounds);
        options::apply(&mut problem, settings, choice)?;
        let bridged = choice.bridge.is_some();
        let timing = if settings.timing && !bridged {
            TimingFile::attach(&mut problem)
        } else {
            None
        };

        let warm = settings.warm_start.is_some();
        let mut iterate = input::initial(start, self.size, warm);
        let mut constraints = vec![f64::NAN; self.size.constraints];
        let mut objective = f64::NAN;
        let mut context = Context::new(&mut *self.nlp, monitor, self.deadline, bridged);
        let code = problem.solve(&mut iterate, &mut constraints, &mut objective, &mut context);
        let record = context.finish();
        // Ipopt closes the timing file and frees the linear solver only with the problem.
        drop(problem);
        let counted = session.end();
        let linear_time = if bridged && settings.timing {
            counted.time
        } else {
            timing.and_then(TimingFile::read).unwrap_or_default()
        };
        let total = begin.elapsed();
        drop(permit);

        if let Some(payload) = record.panic {
            resume_unwind(payload);
        }
        let status = match status::grade(code, &choice.solver)? {
            Status::Interrupted if record.late => Status::TimeLimit,
            status => status,
        };
        let last = record.last;
        let failed = counted.failed || (bridged && code == ipopt_sys::Error_In_Step_Computation);
        let handing = match record.hand_over {
            Some(why) => Some(Handing {
                why,
                from_here: true,
            }),
            None => why_again(status, failed, &counted.trouble, last).map(|why| Handing {
                why,
                from_here: false,
            }),
        };
        let solution = Solution {
            status,
            objective,
            iterate,
            constraints,
            statistics: Statistics {
                solves: 1,
                iterations: last.map_or(0, |last| last.iteration),
                barrier: last.map_or(f64::NAN, |last| last.barrier),
                primal_infeasibility: last.map_or(f64::NAN, |last| last.primal_infeasibility),
                dual_infeasibility: last.map_or(f64::NAN, |last| last.dual_infeasibility),
                evaluations: record.evaluations,
                derivatives: record.derivatives,
                // Rounding to 1 ms may make the parts exceed the whole.
                linear_solver: linear_time.min(total.saturating_sub(record.derivatives)),
                fallbacks: 0,
                singular_fallbacks: 0,
                growth_fallbacks: 0,
                total,
            },
        };
        Ok((solution, handing))
    }
}

/// Why a solve that has ended is to be begun again with MUMPS, if it is.
fn why_again(
    status: Status,
    failed: bool,
    trouble: &Trouble,
    last: Option<Progress>,
) -> Option<HandOver> {
    let stopped = matches!(status, Status::Interrupted | Status::TimeLimit);
    if failed && !status.is_solved() && !stopped {
        return Some(HandOver::Failed);
    }
    let stuck = matches!(
        status,
        Status::RestorationFailed | Status::SearchDirectionTooSmall
    );
    let iterations = last.map_or(0, |last| last.iteration);
    (stuck && trouble.is_often_singular(iterations)).then_some(HandOver::Singular)
}
