//! What is asked before any solve.

use super::PlanError;
use crate::problem::Problem;
use crate::system::impossible;

/// Refuses a task that no motion can carry out, as far as that is seen before any solve.
///
/// # Errors
/// [`PlanError::Impossible`] with every reason found.
pub(crate) fn possible(problem: &Problem) -> Result<(), PlanError> {
    let reasons = impossible(problem);
    match reasons.is_empty() {
        true => Ok(()),
        false => Err(PlanError::Impossible(reasons)),
    }
}
