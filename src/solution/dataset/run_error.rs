//! What keeps a batch from being planned into a folder.

use super::error::DataSetError;
use crate::solution::SolutionError;
use crate::study::batch::EngineError;

/// What keeps a batch from being planned into a folder.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// The folder cannot be used.
    #[error(transparent)]
    DataSet(#[from] DataSetError),
    /// Rows cannot be planned any more.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// The saved solution to start from cannot be used.
    #[error(transparent)]
    Solution(#[from] SolutionError),
    /// A start, and no row that it could be held against.
    #[error("{path}: has no row that is a problem")]
    NoProblem {
        /// The batch file.
        path: String,
    },
    /// Rows to be planned again, of one shard: their part files may be another shard's.
    #[error("--retry takes rows out of the whole folder; give it without --shard")]
    RetryOfShard,
}
