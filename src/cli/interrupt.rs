//! Ctrl-C: once to stop with the best trajectory so far, twice to stop at once.

use super::Outcome;
use super::terminal::warn;
use crate::nlp::ipopt::interrupt;
use std::sync::atomic::Ordering;

/// From now on Ctrl-C makes running solves end as interrupted.
pub(super) fn listen() {
    let handler = || {
        if interrupt::flag().swap(true, Ordering::Relaxed) {
            std::process::exit(Outcome::Interrupted as i32);
        }
        warn("\ninterrupted: ending after this iteration; Ctrl-C again ends at once");
    };
    // Without a handler Ctrl-C still ends the program, only with nothing written.
    if let Err(error) = ctrlc::set_handler(handler) {
        warn(&format!("Ctrl-C will lose the trajectory: {error}"));
    }
}
