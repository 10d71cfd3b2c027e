//! Independent pieces of work on several threads.
//!
//! A caller never hands over what it can do itself: it works on its own pieces from the front, and
//! lasting helpers of the process, if some are free, take pieces from the back. Nothing is allocated
//! once the helpers run, and nobody waits for a helper that has not begun. Results of this crate
//! never depend on the number of threads.

mod for_each;
mod helpers;

pub(crate) use for_each::for_each;

use std::cell::Cell;
use std::num::NonZero;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What the process was told by [`set_default`]; zero means one thread for each processor.
static DEFAULT: AtomicUsize = AtomicUsize::new(0);

thread_local! {
    static CHOSEN: Cell<Option<NonZero<usize>>> = const { Cell::new(None) };
}

/// How many threads this thread's solves may use, itself included: what [`with`] or else
/// [`set_default`] said, or else the number of processors this process may use.
pub fn count() -> usize {
    static PROCESSORS: OnceLock<usize> = OnceLock::new();
    if let Some(chosen) = CHOSEN.get() {
        return chosen.get();
    }
    match DEFAULT.load(Ordering::Relaxed) {
        // Asking the system takes files to be read.
        0 => {
            *PROCESSORS.get_or_init(|| std::thread::available_parallelism().map_or(1, usize::from))
        }
        threads => threads,
    }
}

/// How many threads solves may use where [`with`] does not say otherwise.
pub fn set_default(threads: NonZero<usize>) {
    DEFAULT.store(threads.get(), Ordering::Relaxed);
}

/// Runs `body`, the solves in it using so many threads, this one included.
///
/// For a batch that keeps all processors busy by itself one thread a solve is best:
/// ```
/// use ffsm_ipopt::nlp::threads;
/// use std::num::NonZero;
///
/// let inside = threads::with(NonZero::<usize>::MIN, threads::count);
/// assert_eq!(inside, 1);
/// ```
pub fn with<R>(threads: NonZero<usize>, body: impl FnOnce() -> R) -> R {
    /// Takes the choice back, whether or not the body panics.
    struct Before(Option<NonZero<usize>>);

    impl Drop for Before {
        fn drop(&mut self) {
            CHOSEN.set(self.0);
        }
    }

    let _before = Before(CHOSEN.replace(Some(threads)));
    body()
}
