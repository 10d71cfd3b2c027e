//! Threads that last as long as the process and lend callers a hand.

use std::any::Any;
use std::num::NonZero;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

/// As many helpers as a word has bits; they are started when first asked.
static HELPERS: [Helper; u64::BITS as usize] = [const { Helper::new() }; u64::BITS as usize];

/// What a caller asks a helper to do. It does not live so long: see [`with`].
type Work = &'static (dyn Fn() + Sync);

/// What a panic leaves.
type Payload = Box<dyn Any + Send>;

/// A thread, and what it is doing.
struct Helper {
    state: Mutex<State>,
    /// There may be work for the helper.
    asked: Condvar,
    /// The caller may go on.
    done: Condvar,
}

enum State {
    /// There is no thread yet.
    Unborn,
    Free,
    /// The caller may still take this back.
    Asked(Work),
    Busy,
    /// The caller has not taken notice yet.
    Done(Option<Payload>),
}

/// Runs `own` on this thread, and meanwhile `help` on up to `most` others, once on each. Helpers
/// that have not begun when `own` is done are not waited for.
///
/// # Panics
/// Where `own` or a `help` does, after all of them have stopped.
pub(super) fn with(most: usize, help: &(dyn Fn() + Sync), own: impl FnOnce()) {
    // SAFETY: helpers use this only between being asked and having been dismissed, and `asked`
    // dismisses all of them before this function returns or unwinds.
    let help = unsafe { std::mem::transmute::<&(dyn Fn() + Sync), Work>(help) };
    let mut asked = Asked(0);
    for (k, helper) in HELPERS.iter().enumerate() {
        if asked.0.count_ones() as usize == most {
            break;
        }
        if helper.ask(k, help) {
            asked.0 |= 1 << k;
        }
    }
    own();
    if let Some(payload) = asked.dismiss() {
        resume_unwind(payload);
    }
}

/// The helpers a caller has asked, one a bit.
struct Asked(u64);

impl Asked {
    /// Returns when none of them uses the caller's work any more, with the first one's panic.
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
            state: Mutex::new(State::Unborn),
            asked: Condvar::new(),
            done: Condvar::new(),
        }
    }

    /// Asks the helper, which is number `k`, unless it has other work or cannot be started.
    fn ask(&'static self, k: usize, work: Work) -> bool {
        // Whoever holds the lock is another caller.
        let Ok(mut state) = self.state.try_lock() else {
            return false;
        };
        match *state {
            State::Free => {}
            State::Unborn => {
                let named = thread::Builder::new().name(format!("ffsm-helper-{k}"));
                if named.spawn(|| self.serve()).is_err() {
                    return false;
                }
            }
            State::Asked(_) | State::Busy | State::Done(_) => return false,
        }
        *state = State::Asked(work);
        drop(state);
        self.asked.notify_one();
        true
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
                State::Asked(_) | State::Free | State::Unborn => return None,
            }
        }
    }

    /// What the thread does.
    fn serve(&self) {
        // A helper's own work is not worth dividing again.
        super::with(NonZero::<usize>::MIN, || {
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

    /// Nothing but a change of the state happens under the lock.
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
