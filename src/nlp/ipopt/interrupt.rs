//! Ctrl-C: a flag for the whole process, looked at after each iteration.
//!
//! A library installs no signal handlers; a program that does lets its handler set [`flag`].

use std::sync::atomic::{AtomicBool, Ordering};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// The flag. Every running solve ends as interrupted while it is set; who sets it clears it.
pub fn flag() -> &'static AtomicBool {
    &INTERRUPTED
}

/// Whether the flag is set.
pub fn requested() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}
