//! What is wrong with an input file: where, which key, what stands there, what was expected.

use crate::dynamics::{InertiaError, ModelError};
use std::fmt;
use std::sync::Arc;

/// Where a value was given: a line of a file, a whole file or an option of the command line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The file as it was named, or the option as it was written.
    pub source: Arc<str>,
    /// Line in the file, counted from 1; `None` for the whole file and for options.
    pub line: Option<usize>,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}:{line}", self.source),
            None => f.write_str(&self.source),
        }
    }
}

/// An input that cannot be used. Its message is always one line and says all: a `cause` is part of
/// it, so that it is no [`source`](std::error::Error::source) to be said once more.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ConfigError {
    /// A file that cannot be read.
    #[error("{place}: cannot be read: {reason}; expected {expected}")]
    Unreadable {
        /// The file; for a file named by another, the line that names it.
        place: Place,
        /// What the system says.
        reason: String,
        /// What was expected there.
        expected: &'static str,
    },
    /// A file that is not TOML, or a file format that is not read.
    #[error("{place}: {message}")]
    Format {
        /// The line.
        place: Place,
        /// What is wrong with it.
        message: String,
    },
    /// A key that means nothing.
    #[error("{place}: {key}: unknown key; {hint}")]
    UnknownKey {
        /// The line.
        place: Place,
        /// Full key path.
        key: String,
        /// The nearest key, or all there are.
        hint: String,
    },
    /// A key that must be there.
    #[error("{place}: {key}: missing; expected {expected}")]
    Missing {
        /// The table that lacks it.
        place: Place,
        /// Full key path.
        key: String,
        /// What was expected.
        expected: String,
    },
    /// A value that cannot be used.
    #[error("{place}: {key}: {found}; expected {expected}")]
    Value {
        /// The line.
        place: Place,
        /// Full key path.
        key: String,
        /// What stands there.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// Mass properties that no body has.
    #[error("{place}: {key}: {cause}")]
    Inertia {
        /// The line.
        place: Place,
        /// Full key path.
        key: String,
        /// What is wrong with them.
        cause: InertiaError,
    },
    /// Joints that make no robot.
    #[error("{place}: {key}: {cause}")]
    Model {
        /// The line.
        place: Place,
        /// Full key path.
        key: String,
        /// What is wrong with them.
        cause: ModelError,
    },
}
