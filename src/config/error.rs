//! What is wrong with an input file: where, which key, what stands there, what was expected.

use crate::dynamics::{InertiaError, ModelError};
use crate::problem::Impossible;
use std::borrow::Cow;
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
    /// Mass properties in a robot's file that no body has.
    #[error("{place}: {key}: {cause}; {remedy}")]
    Unphysical {
        /// The line.
        place: Place,
        /// The body's inertia in the file.
        key: String,
        /// What is wrong with it.
        cause: InertiaError,
        /// What can be done about it.
        remedy: Remedy,
    },
    /// A task that no motion can carry out.
    #[error("{place}: {cause}")]
    Impossible {
        /// The line.
        place: Place,
        /// Why.
        cause: Box<Impossible>,
    },
    /// A key of a batch whose value is not what the problem then has there.
    #[error(
        "{place}: {key}: {given} was given, and the problem {}; expected a key whose value gets into \
         the problem",
        .found.as_ref().map_or("says nothing of it".into(), |found| format!("has {found}"))
    )]
    Unvaried {
        /// The line of the batch file.
        place: Place,
        /// Full key path.
        key: String,
        /// What was given.
        given: String,
        /// What the problem has; `None` where it says nothing of such a key.
        found: Option<String>,
    },
    /// Several things that are wrong with one file.
    #[error("{place}: {} faults: {}", .faults.len(), listed(.faults))]
    Several {
        /// The file.
        place: Place,
        /// All of them; the message has the first.
        faults: Vec<ConfigError>,
    },
}

/// What can be done about an inertia that no body has.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Remedy {
    /// The nearest inertia of a body, on request.
    Repair,
    /// None but another figure: the nearest inertia of a body, with these principal moments in
    /// kg m², is too far away to be what was meant.
    Correct([f64; 3]),
    /// A mass for the link.
    Mass,
}

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Repair => f.write_str(
                "robot.repair = \"inertia\" (or --repair) takes the nearest that a body can have",
            ),
            Self::Correct([a, b, c]) => write!(
                f,
                "too far off for robot.repair, and a joint moves it; the nearest that a body can \
                 have is {a:.3e}, {b:.3e}, {c:.3e}"
            ),
            Self::Mass => {
                f.write_str("a joint moves it, so that robot.repair needs robot.minimum_mass")
            }
        }
    }
}

/// Faults that are said; the others are counted.
const LISTED: usize = 8;

fn listed(faults: &[ConfigError]) -> String {
    let listed = faults.iter().take(LISTED).enumerate();
    let mut parts: Vec<String> = listed
        .map(|(i, fault)| format!("({}) {fault}", i + 1))
        .collect();
    if faults.len() > LISTED {
        parts.push(format!("and {} more", faults.len() - LISTED));
    }
    parts.join("; ")
}

/// The place of an error, borrowed as the error is.
macro_rules! place_of {
    ($error:expr) => {
        match $error {
            Self::Unreadable { place, .. }
            | Self::Format { place, .. }
            | Self::UnknownKey { place, .. }
            | Self::Missing { place, .. }
            | Self::Value { place, .. }
            | Self::Inertia { place, .. }
            | Self::Model { place, .. }
            | Self::Unphysical { place, .. }
            | Self::Impossible { place, .. }
            | Self::Unvaried { place, .. }
            | Self::Several { place, .. } => place,
        }
    };
}

impl ConfigError {
    /// Where it is.
    pub fn place(&self) -> &Place {
        place_of!(self)
    }

    /// The key it is about, where it is about one; of several faults that of the first.
    pub fn key(&self) -> Option<Cow<'_, str>> {
        match self {
            Self::Unreadable { .. } | Self::Format { .. } => None,
            Self::UnknownKey { key, .. }
            | Self::Missing { key, .. }
            | Self::Value { key, .. }
            | Self::Inertia { key, .. }
            | Self::Model { key, .. }
            | Self::Unphysical { key, .. }
            | Self::Unvaried { key, .. } => Some(key.into()),
            Self::Impossible { cause, .. } => Some(cause.key().into()),
            Self::Several { faults, .. } => faults.first().and_then(Self::key),
        }
    }

    /// The same without lines of `source`, for a text that nobody has seen.
    pub fn without_lines_of(mut self, source: &str) -> Self {
        if let Self::Several { faults, .. } = &mut self {
            let without = |fault: Self| fault.without_lines_of(source);
            *faults = std::mem::take(faults).into_iter().map(without).collect();
        }
        let place = self.place_mut();
        if *place.source == *source {
            place.line = None;
        }
        self
    }

    fn place_mut(&mut self) -> &mut Place {
        place_of!(self)
    }
}
