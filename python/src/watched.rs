//! Work on a thread of its own, watched by the thread that called.
//!
//! A search tells its monitor from any thread, but Python tells of signals on the main thread alone, which
//! would be at work on a start, or waiting for another's.

use crate::monitor::Monitor;
use crate::progress::Progress;
use ffsm_ipopt::nlp::Control;
use pyo3::prelude::*;
use std::io;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// Stack of the thread, bytes: that of a main thread.
const STACK: usize = 8 << 20;
/// How often signals are asked for where nothing is told.
const TICK: Duration = Duration::from_millis(20);

/// What the work tells each step to, if it is one that a user asks for.
pub type Teller<'a> = dyn Fn(Option<Progress>) -> Control + Sync + 'a;

/// Runs `work`; `monitor` is told here of what it tells, and can stop it.
pub fn watched<R: Send>(
    monitor: &mut Monitor,
    work: impl FnOnce(&Teller<'_>) -> R + Send,
) -> io::Result<R> {
    let stop = AtomicBool::new(false);
    let (sender, steps) = channel();
    std::thread::scope(|scope| {
        let stop = &stop;
        let worker = std::thread::Builder::new()
            .name("search".into())
            .stack_size(STACK)
            .spawn_scoped(scope, move || {
                work(&|step: Option<Progress>| {
                    if let Some(step) = step {
                        // Nobody listens any more only once the work is done.
                        let _ = sender.send(step);
                    }
                    match stop.load(Ordering::Relaxed) {
                        true => Control::Stop,
                        false => Control::Continue,
                    }
                })
            })?;
        loop {
            let control = match steps.recv_timeout(TICK) {
                Ok(step) => monitor.tell(|_, callback| callback.call1((step.values(),)).map(drop)),
                Err(RecvTimeoutError::Timeout) => monitor.ask(),
                Err(RecvTimeoutError::Disconnected) => break,
            };
            if control == Control::Stop {
                stop.store(true, Ordering::Relaxed);
            }
        }
        Ok(worker.join().unwrap_or_else(|panic| resume_unwind(panic)))
    })
}
