//! One monitor for work on several threads.

use super::event::SearchEvent;
use crate::nlp::Control;
use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

type Monitor<'m> = &'m mut (dyn FnMut(&SearchEvent<'_>) -> Control + Send);

/// The monitor, told by one thread at a time; once it says stop, all of them stop.
pub(super) struct Teller<'m> {
    monitor: Mutex<Monitor<'m>>,
    stopped: AtomicBool,
}

impl fmt::Debug for Teller<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Teller")
            .field("stopped", &self.stopped)
            .finish_non_exhaustive()
    }
}

impl<'m> Teller<'m> {
    pub fn new(monitor: Monitor<'m>) -> Self {
        Self {
            monitor: Mutex::new(monitor),
            stopped: AtomicBool::new(false),
        }
    }

    pub fn tell(&self, event: &SearchEvent<'_>) -> Control {
        if !self.has_stopped() {
            let mut monitor = self.monitor.lock().unwrap_or_else(PoisonError::into_inner);
            if monitor(event) == Control::Stop {
                self.stopped.store(true, Ordering::Relaxed);
            }
        }
        self.answer()
    }

    /// What the monitor said last.
    pub fn answer(&self) -> Control {
        match self.has_stopped() {
            true => Control::Stop,
            false => Control::Continue,
        }
    }

    pub fn has_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }
}
