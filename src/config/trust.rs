//! Whether the options of Ipopt in a file may load code and touch files.
//!
//! A problem file says what to plan. Options that load a library, or read and write files, are refused
//! from it, unless the user of this process said otherwise; on the command line they are the user's
//! own.

use super::ConfigError;
use super::item::Item;
use crate::nlp::ipopt::OptionAccess;
use std::sync::atomic::{AtomicBool, Ordering};

static TRUSTED: AtomicBool = AtomicBool::new(false);

/// From now on files read by this process may set any option of Ipopt: `--trust-options`.
pub fn trust_options() {
    TRUSTED.store(true, Ordering::Relaxed);
}

/// Whether they may.
pub fn trusts_options() -> bool {
    TRUSTED.load(Ordering::Relaxed)
}

/// Where the values of a document come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Origin {
    /// A file, with values of this process's command line laid over it.
    CommandLine,
    /// A saved solution, the options of the command line that it was made with included.
    Kept,
}

impl Origin {
    /// Refuses `item`, an option of Ipopt that has `reach`, where nobody who may has set it.
    pub(super) fn check(
        self,
        item: &Item<'_>,
        reach: Option<OptionAccess>,
    ) -> Result<(), ConfigError> {
        // Options of the command line stand on no line.
        let own = self == Self::CommandLine && item.node.place.line.is_none();
        match reach {
            Some(reach) if !own && !trusts_options() => Err(item.error(
                format!("{}, which {reach}", item.node.describe()),
                "no such option in a file; --trust-options allows it, or give it by --set",
            )),
            _ => Ok(()),
        }
    }
}
