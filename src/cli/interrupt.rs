//! Signals that end a program, SIGINT, SIGTERM and SIGHUP: once to stop with the best trajectory so
//! far, twice to stop at once.

use super::Outcome;
use super::terminal::warn;
use crate::nlp::ipopt::interrupt;
use crate::report::settled;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether there is something to end with.
static SOLVING: AtomicBool = AtomicBool::new(false);

/// From now on a signal ends the program only between files, so that no part of a set is left behind.
pub(super) fn guard() {
    let mut wanted = vec![SIGINT, SIGTERM];
    if !hangup_is_ignored() {
        wanted.push(SIGHUP);
    }
    let listening = Signals::new(wanted).and_then(|mut signals| {
        let listen = move || signals.forever().for_each(|_| handle());
        std::thread::Builder::new()
            .name("signals".into())
            .spawn(listen)
    });
    // Without a handler a signal still ends the program, only with nothing written.
    if let Err(error) = listening {
        warn(&format!("a signal will lose the trajectory: {error}"));
    }
}

/// From now on signals that end a batch do nothing here: it ends its workers itself.
pub(super) fn leave_to_batch() {
    // Without handlers a worker only ends sooner than it is told to.
    if let Ok(mut signals) = Signals::new([SIGINT, SIGTERM, SIGHUP]) {
        let ignore = move || signals.forever().for_each(drop);
        let _ = std::thread::Builder::new()
            .name("signals".into())
            .spawn(ignore);
    }
}

/// From now on a signal makes running solves end as interrupted.
pub(super) fn listen() {
    SOLVING.store(true, Ordering::Relaxed);
}

fn handle() {
    if SOLVING.load(Ordering::Relaxed) && !interrupt::flag().swap(true, Ordering::Relaxed) {
        warn("\ninterrupted: ending after this iteration; Ctrl-C again ends at once");
        return;
    }
    settled(|| std::process::exit(Outcome::Interrupted as i32));
}

/// Whether this process was started to outlive its terminal, as by nohup.
fn hangup_is_ignored() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (SIGHUP - 1) & 1 == 1)
}
