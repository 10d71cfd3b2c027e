//! One solve at a time, for linear solvers that keep state outside their problem.

use super::IpoptError;
use crate::nlp::LinearSolver;
use std::cell::Cell;
use std::sync::{Mutex, MutexGuard, PoisonError};

static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

thread_local! {
    static SOLVING: Cell<bool> = const { Cell::new(false) };
}

/// Whether solves with this linear solver wait for each other.
///
/// Two concurrent solves with MUMPS crash: it has Fortran module variables. The multifrontal solver
/// and HSL_MA97 have no state outside their arguments. Of the others nothing is known, so they wait.
/// [`LinearSolver::Auto`] may come to MUMPS: ask for what [`super::linear_solver`] makes of it.
pub fn serialised(linear_solver: &LinearSolver) -> bool {
    !matches!(
        linear_solver,
        LinearSolver::Multifrontal | LinearSolver::Ma97
    )
}

/// The permission to solve; a linear solver that is not [`serialised`] needs no lock for it.
pub(super) struct Permit(Option<MutexGuard<'static, ()>>);

/// Waits for the permission to solve with `linear_solver`.
///
/// # Errors
/// [`IpoptError::Nested`] where this thread holds the lock already.
pub(super) fn permit(linear_solver: &LinearSolver) -> Result<Permit, IpoptError> {
    if !serialised(linear_solver) {
        return Ok(Permit(None));
    }
    if SOLVING.get() {
        return Err(IpoptError::Nested(linear_solver.clone()));
    }
    // The lock guards no data, so that a panic while it was held leaves nothing broken.
    let guard = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    SOLVING.set(true);
    Ok(Permit(Some(guard)))
}

impl Drop for Permit {
    fn drop(&mut self) {
        if self.0.is_some() {
            SOLVING.set(false);
        }
    }
}
