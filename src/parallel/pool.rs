//! The pool: threads that last as long as the process and help callers.

#![expect(
    unsafe_code,
    reason = "a caller's work is lent to threads that outlive it; Miri tests it"
)]

use std::any::Any;
use std::num::NonZero;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

/// As many pool threads as a word has bits; each is started when it is first asked.
static HELPERS: [Helper; u64::BITS as usize] = [const { Helper::new() }; u64::BITS as usize];

/// What a caller asks a helper to do. The lifetime is a promise kept by [`with_help`]: the work
/// lives only as long as the call.
type Work = &'static (dyn Fn() + Sync);

/// The payload of a panic.
type Payload = Box<dyn Any + Send>;

/// A pool thread and its state.
struct Helper {
    state: Mutex<State>,
    /// Signalled when there may be work for the helper.
    asked: Condvar,
    /// Signalled when the helper has finished its work.
    done: Condvar,
}

enum State {
    /// There is no thread yet.
    NotStarted,
    Free,
    /// Asked, but not begun: the caller may still take the work back.
    Asked(Work),
    Busy,
    /// Finished, with the payload of a panic; the caller has not seen it yet.
    Done(Option<Payload>),
}

/// Runs `own` on this thread, and meanwhile `help` on up to `most` others, once on each. Helpers
/// that have not begun when `own` is done are not waited for.
///
/// # Panics
/// Where `own` or a `help` does, after all of them have stopped.
pub(super) fn with_help(most: usize, help: &(dyn Fn() + Sync), own: impl FnOnce()) {
    // SAFETY: helpers use this only between being asked and having been dismissed, and `asked`
    // dismisses all of them before this function returns or unwinds.
    let help = unsafe { std::mem::transmute::<&(dyn Fn() + Sync), Work>(help) };
    let mut asked = Asked(0);
    let mut left = most;
    for (k, helper) in HELPERS.iter().enumerate() {
        if left == 0 {
            break;
        }
        match helper.ask(k, help) {
            Answer::Asked => {
                asked.0 |= 1 << k;
                left -= 1;
            }
            Answer::Changing => left -= 1,
            Answer::Unavailable => {}
        }
    }
    own();
    if let Some(payload) = asked.dismiss() {
        resume_unwind(payload);
    }
}

/// What came of asking a helper.
enum Answer {
    Asked,
    /// It has other work, or cannot be started.
    Unavailable,
    /// Its state is changing at this moment. It is mostly a free one that woke too late for its
    /// last work, so that a further one in its place would be one thread too many.
    Changing,
}

/// The helpers that a caller has asked, one bit for each.
struct Asked(u64);

impl Asked {
    /// Waits until none of them uses the caller's work any more; returns the first panic.
    fn dismiss(&mut self) -> Option<Payload> {
        let mut panic = None;
        while self.0 != 0 {
            let next = self.0.trailing_zeros();
            let payload = HELPERS[next as usize].dismiss();
            self.0 &= self.0 - 1;
            panic = panic.or(payload);
        }
        panic
    }
}

impl Drop for Asked {
    fn drop(&mut self) {
        self.dismiss();
    }
}

impl Helper {
    const fn new() -> Self {
        Self {
            state: Mutex::new(State::NotStarted),
            asked: Condvar::new(),
            done: Condvar::new(),
        }
    }

    /// Asks the helper, which is number `k`; waits for nobody.
    fn ask(&'static self, k: usize, work: Work) -> Answer {
        let Ok(mut state) = self.state.try_lock() else {
            return Answer::Changing;
        };
        match *state {
            State::Free => {}
            State::NotStarted => {
                let named = thread::Builder::new().name(format!("ffsm-helper-{k}"));
                if named.spawn(|| self.serve()).is_err() {
                    return Answer::Unavailable;
                }
            }
            State::Asked(_) | State::Busy | State::Done(_) => return Answer::Unavailable,
        }
        *state = State::Asked(work);
        drop(state);
        self.asked.notify_one();
        Answer::Asked
    }

    /// Takes back what the helper was asked for, or waits until it is done.
    fn dismiss(&self) -> Option<Payload> {
        let mut state = self.lock();
        loop {
            match std::mem::replace(&mut *state, State::Free) {
                State::Done(payload) => return payload,
                State::Busy => {
                    *state = State::Busy;
                    state = self
                        .done
                        .wait(state)
                        .unwrap_or_else(PoisonError::into_inner);
                }
                State::Asked(_) | State::Free | State::NotStarted => return None,
            }
        }
    }

    /// The loop of the thread.
    fn serve(&self) {
        // Work inside a helper is not divided again: the other threads are busy already.
        super::with_threads(NonZero::<usize>::MIN, || {
            let mut state = self.lock();
            loop {
                if let State::Asked(work) = *state {
                    *state = State::Busy;
                    drop(state);
                    let payload = catch_unwind(AssertUnwindSafe(work)).err();
                    state = self.lock();
                    *state = State::Done(payload);
                    self.done.notify_one();
                } else {
                    state = self
                        .asked
                        .wait(state)
                        .unwrap_or_else(PoisonError::into_inner);
                }
            }
        });
    }

    /// A poisoned lock is usable: nothing but a change of state happens under it.
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
