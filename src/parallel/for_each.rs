//! Every item of an iterator by one of several workers.

use super::pool;
use std::sync::{Mutex, PoisonError};

/// Runs `body` on every item. This thread takes items from the front with the first worker; for
/// each further worker a pool thread, if one is free, takes items from the back.
///
/// The caller's data so stay in its processor's cache, and in repeated calls an item near either
/// end mostly runs on the same core again.
pub(crate) fn for_each<W: Send, T: Send>(
    workers: &mut [W],
    items: impl DoubleEndedIterator<Item = T> + Send,
    body: impl Fn(&mut W, T) + Sync,
) {
    let Some((own, others)) = workers.split_first_mut() else {
        return;
    };
    if others.is_empty() {
        items.for_each(|item| body(own, item));
        return;
    }
    let most = others.len();
    let items = Mutex::new(items);
    let others = Mutex::new(others.iter_mut());
    let first = || locked(&items).next();
    let last = || locked(&items).next_back();
    let another = || locked(&others).next();
    let help = || {
        if let Some(worker) = another() {
            while let Some(item) = last() {
                body(worker, item);
            }
        }
    };
    pool::with_help(most, &help, || {
        while let Some(item) = first() {
            body(own, item);
        }
    });
}

/// A poisoned lock is usable: only an iterator's step runs under it, and a step that panicked has
/// left nothing half done.
fn locked<T>(mutex: &Mutex<T>) -> impl std::ops::DerefMut<Target = T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::for_each;
    use std::panic::{AssertUnwindSafe, catch_unwind};
    use std::sync::{Condvar, Mutex};
    use std::time::Duration;

    #[test]
    fn every_item_once_whatever_the_workers() {
        for workers in 1..5 {
            let mut counts = vec![0_usize; workers];
            let mut items = vec![0_u8; 1000];
            for_each(&mut counts, items.iter_mut(), |count, item| {
                *item += 1;
                *count += 1;
            });
            assert!(items.iter().all(|&item| item == 1));
            assert_eq!(counts.iter().sum::<usize>(), items.len());
        }
    }

    #[test]
    fn nothing_without_workers() {
        let mut items = [0];
        for_each(&mut [] as &mut [()], items.iter_mut(), |(), item| *item = 1);
        assert_eq!(items, [0]);
    }

    #[test]
    fn many_callers_at_a_time_and_callers_in_the_pool() {
        let square = |_: &mut (), item: &mut u64| {
            let mut inner = [*item; 4];
            for_each(&mut [(); 3], inner.iter_mut(), |(), inner| *inner *= 2);
            *item = inner.iter().sum();
        };
        let rounds = if cfg!(miri) { 3 } else { 50 };
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    for _ in 0..rounds {
                        let mut items: Vec<u64> = (0..40).collect();
                        for_each(&mut [(); 4], items.iter_mut(), square);
                        assert!(items.iter().zip(0..).all(|(&item, i)| item == 8 * i));
                    }
                });
            }
        });
    }

    /// Whether two threads are here at the same time; not for ever.
    struct Meeting {
        here: Mutex<u32>,
        came: Condvar,
    }

    impl Meeting {
        fn is_held(&self) -> bool {
            let mut here = self.here.lock().unwrap();
            *here += 1;
            self.came.notify_all();
            let enough = Duration::from_secs(1);
            let alone = |here: &mut u32| *here < 2;
            let (here, _) = self.came.wait_timeout_while(here, enough, alone).unwrap();
            *here >= 2
        }
    }

    #[test]
    fn a_panic_of_either_side_reaches_the_caller_after_all_have_stopped() {
        for which in 0..2 {
            // The two items wait for each other, so that two threads are needed. A helper that other
            // tests keep changing is not asked: then once more.
            let tried = (0..20).find_map(|_| {
                let meeting = Meeting {
                    here: Mutex::new(0),
                    came: Condvar::new(),
                };
                let mut items = [0, 1];
                let mut done = [false; 2];
                let panic = catch_unwind(AssertUnwindSafe(|| {
                    let items = items.iter_mut().zip(done.iter_mut());
                    for_each(&mut [(); 2], items, |(), (item, done)| {
                        if meeting.is_held() {
                            assert_ne!(*item, which, "as planned");
                            *done = true;
                        }
                    });
                }));
                panic.err().map(|payload| (payload, done))
            });
            let (message, done) = tried.expect("two threads, once in twenty times");
            let message = message.downcast_ref::<String>().unwrap();
            assert!(message.contains("as planned"), "{message}");
            assert_eq!(done, [which != 0, which != 1]);
        }
    }
}
