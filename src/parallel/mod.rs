//! Fork and join: independent pieces of work on several threads.
//!
//! | file | does |
//! | --- | --- |
//! | `pool` | the threads, which last as long as the process |
//! | `for_each` | every item of an iterator, by one of several workers |
//! | `map` | a function of every index, results in order |
//! | `both` | two unlike pieces of work |
//! | `share` | threads that large items of work divide among themselves |
//!
//! The calling thread always works too: it takes pieces from the front, and threads of the pool
//! that are free take pieces from the back. Nobody waits for a pool thread that has not begun, and
//! once the pool runs, nothing is allocated. The pieces never depend on the number of threads, so
//! neither do results.

#![warn(missing_debug_implementations)]

mod both;
mod for_each;
mod map;
mod pool;
mod share;

pub(crate) use both::both;
pub(crate) use for_each::for_each;
pub(crate) use map::map;
pub(crate) use share::map_sharing;

use share::Share;
use std::cell::RefCell;
use std::num::NonZero;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The process's number of threads; zero means one thread for each processor.
static DEFAULT: AtomicUsize = AtomicUsize::new(0);

/// Who says how many threads the work of a thread uses.
#[derive(Debug, Clone)]
enum Chosen {
    /// [`with_threads`].
    Fixed(NonZero<usize>),
    /// [`map_sharing`]: more as soon as other items have ended.
    Shared(Share),
}

thread_local! {
    /// What was chosen for this thread; nothing where the process's number holds.
    static CHOSEN: RefCell<Option<Chosen>> = const { RefCell::new(None) };
}

/// How many threads the work of this thread may use, itself included.
///
/// It is the number given to [`with_threads`], else that given to [`set_thread_count`], else the
/// number of processors this process may use.
pub fn thread_count() -> usize {
    CHOSEN.with_borrow(|chosen| match chosen {
        Some(Chosen::Fixed(threads)) => threads.get(),
        Some(Chosen::Shared(share)) => share.now(),
        None => of_process(),
    })
}

/// How many [`thread_count`] may come to while the present work goes on.
pub(crate) fn most_threads() -> usize {
    CHOSEN.with_borrow(|chosen| match chosen {
        Some(Chosen::Fixed(threads)) => threads.get(),
        Some(Chosen::Shared(share)) => share.most(),
        None => of_process(),
    })
}

/// How many threads work uses for which nothing was chosen.
fn of_process() -> usize {
    static PROCESSORS: OnceLock<usize> = OnceLock::new();
    match DEFAULT.load(Ordering::Relaxed) {
        // Asked once: the standard library reads files to answer.
        0 => {
            *PROCESSORS.get_or_init(|| std::thread::available_parallelism().map_or(1, usize::from))
        }
        threads => threads,
    }
}

/// Sets how many threads the process uses outside [`with_threads`].
pub fn set_thread_count(threads: NonZero<usize>) {
    DEFAULT.store(threads.get(), Ordering::Relaxed);
}

/// Runs `body`; the work in it uses this many threads, the calling one included.
///
/// For a batch that keeps all processors busy by itself, one thread for each solve is best:
/// ```
/// use ffsm_ipopt::parallel;
/// use std::num::NonZero;
///
/// let inside = parallel::with_threads(NonZero::<usize>::MIN, parallel::thread_count);
/// assert_eq!(inside, 1);
/// ```
pub fn with_threads<R>(threads: NonZero<usize>, body: impl FnOnce() -> R) -> R {
    with(Chosen::Fixed(threads), body)
}

/// Runs `body` with what is chosen for it.
fn with<R>(chosen: Chosen, body: impl FnOnce() -> R) -> R {
    /// Restores the earlier choice, also where the body panics.
    struct Restore(Option<Chosen>);

    impl Drop for Restore {
        fn drop(&mut self) {
            CHOSEN.set(self.0.take());
        }
    }

    let _restore = Restore(CHOSEN.replace(Some(chosen)));
    body()
}
