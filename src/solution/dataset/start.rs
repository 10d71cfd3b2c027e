//! The saved solution that all rows of a batch start from.

use super::run_error::RunError;
use crate::config::BatchFile;
use crate::planner::Start;
use crate::solution::read_warm_start;
use std::path::Path;

/// Reads a `solution.json` that every plan of `batch` is to start from. It has to fit the first row that
/// is a problem.
///
/// # Errors
/// [`RunError::Solution`] where it cannot be used, [`RunError::NoProblem`] where there is no such row.
pub fn start(batch: &BatchFile, solution: &Path) -> Result<Start, RunError> {
    let mut rows = (0..batch.count()).filter_map(|position| batch.row(position).ok());
    let first = rows.next().ok_or_else(|| RunError::NoProblem {
        path: batch.path.clone(),
    })?;
    Ok(read_warm_start(solution, &first.file)?.start)
}
