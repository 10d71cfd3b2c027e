//! Faults of one file, collected so that all of them are said at once.

use super::{ConfigError, Place};

/// The faults found so far.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Faults {
    found: Vec<ConfigError>,
}

impl Faults {
    /// Adds a fault, or those that one is made of.
    pub(super) fn push(&mut self, fault: ConfigError) {
        match fault {
            ConfigError::Several { faults, .. } => self.found.extend(faults),
            fault => self.found.push(fault),
        }
    }

    /// What was read; where it could not be, its fault is kept.
    pub(super) fn keep<T>(&mut self, read: Result<T, ConfigError>) -> Option<T> {
        read.map_err(|fault| self.push(fault)).ok()
    }

    /// Adds those of `other`.
    pub(super) fn append(&mut self, other: Self) {
        self.found.extend(other.found);
    }

    /// All of them.
    pub(super) fn into_list(self) -> Vec<ConfigError> {
        self.found
    }

    /// Whether there are none.
    pub(super) fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// All of them as one error, in the order of their lines; `place` is the file, and faults in
    /// others come last. There has to be one.
    pub(super) fn into_error(mut self, place: Place) -> ConfigError {
        self.found.sort_by_key(|fault| {
            let Place { source, line } = fault.place();
            (*source != place.source, line.unwrap_or(usize::MAX))
        });
        match self.found.len() {
            1 => self.found.remove(0),
            _ => ConfigError::Several {
                place,
                faults: self.found,
            },
        }
    }
}

impl From<ConfigError> for Faults {
    fn from(fault: ConfigError) -> Self {
        let mut faults = Self::default();
        faults.push(fault);
        faults
    }
}
