//! What keeps a batch from going on.

use std::io;
use std::path::PathBuf;
use std::process::ExitStatus;

/// What keeps a batch from going on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EngineError {
    /// A thread cannot be started.
    #[error("a thread to plan on cannot be started: {0}")]
    Thread(io::Error),
    /// A worker cannot be started or spoken to.
    #[error("{}: the process to plan in cannot be started: {cause}", program.display())]
    Start {
        /// The program.
        program: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// A worker that ended before it was given a row.
    #[error("{}: the process to plan in ended at once: {status}", program.display())]
    Worker {
        /// The program.
        program: PathBuf,
        /// How it ended.
        status: ExitStatus,
    },
}
