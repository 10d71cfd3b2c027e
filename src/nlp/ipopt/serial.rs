//! One solve at a time, for linear solvers that keep state outside their problem.

use super::IpoptError;
use std::cell::Cell;
use std::sync::{Mutex, MutexGuard, PoisonError};

static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

thread_local! {
    static SOLVING: Cell<bool> = const { Cell::new(false) };
}

/// Whether solves with this linear solver wait for each other.
///
/// Two concurrent solves with MUMPS crash: it has Fortran module variables. Ours and HSL_MA97 have
/// no state outside their arguments; of the rest nothing is known, so they wait too.
pub fn serialised(linear_solver: &str) -> bool {
    !["ours", "ma97"]
        .iter()
        .any(|name| linear_solver.eq_ignore_ascii_case(name))
}

/// The right to solve, where there is need of one; given back when dropped.
pub(super) struct Turn(Option<MutexGuard<'static, ()>>);

/// Waits for the right to solve with `linear_solver`.
pub(super) fn turn(linear_solver: &str) -> Result<Turn, IpoptError> {
    if !serialised(linear_solver) {
        return Ok(Turn(None));
    }
    if SOLVING.get() {
        return Err(IpoptError::Nested(linear_solver.to_owned()));
    }
    // The lock guards no data, so that a panic while it was held leaves nothing broken.
    let guard = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    SOLVING.set(true);
    Ok(Turn(Some(guard)))
}

impl Drop for Turn {
    fn drop(&mut self) {
        if self.0.is_some() {
            SOLVING.set(false);
        }
    }
}
