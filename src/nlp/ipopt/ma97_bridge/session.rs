//! What each thread counts of its solve.

use crate::nlp::ipopt::trouble::Trouble;
use ipopt_sys::ma97::Routines;
use std::cell::RefCell;
use std::time::Duration;

/// What the calls of one solve come to.
#[derive(Debug, Default)]
pub(in crate::nlp::ipopt) struct Count {
    /// Time in analyses, factorisations and solutions.
    pub time: Duration,
    /// Whether a call has failed.
    pub failed: bool,
    /// Systems that were singular, and factors that grew.
    pub trouble: Trouble,
    /// The routines of the real HSL_MA97, where all calls go to them.
    hsl: Option<Routines>,
}

thread_local! {
    static COUNT: RefCell<Count> = RefCell::default();
}

/// One solve on this thread: its calls are counted from `begin` to `end`.
pub(in crate::nlp::ipopt) struct Session {
    /// The count of the solve that this one is nested in.
    outer: Option<Count>,
}

impl Session {
    pub(in crate::nlp::ipopt) fn begin(hsl: Option<Routines>) -> Self {
        let count = Count {
            hsl,
            ..Count::default()
        };
        Self {
            outer: Some(COUNT.replace(count)),
        }
    }

    pub(in crate::nlp::ipopt) fn end(mut self) -> Count {
        COUNT.replace(self.outer.take().unwrap_or_default())
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        if let Some(outer) = self.outer.take() {
            COUNT.set(outer);
        }
    }
}

/// The trouble that this thread's solve has met so far, to be noted at the end of each iteration.
pub(in crate::nlp::ipopt) fn with_trouble<T>(body: impl FnOnce(&mut Trouble) -> T) -> T {
    COUNT.with_borrow_mut(|count| body(&mut count.trouble))
}

/// The routines of the real HSL_MA97, where this solve is to use them.
pub(super) fn hsl() -> Option<Routines> {
    COUNT.with_borrow(|count| count.hsl)
}

/// Counts a call that took this time, and whether it failed.
pub(super) fn served(time: Duration, failed: bool) {
    COUNT.with_borrow_mut(|count| {
        count.time += time;
        count.failed |= failed;
    });
}
