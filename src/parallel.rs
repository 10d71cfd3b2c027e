//! Independent pieces of work on several threads.

use std::sync::{Mutex, PoisonError};

/// Runs `body` on every item. This thread takes items from the front, and with each further worker
/// a thread of rayon's pool, if one is free, takes them from the back.
///
/// The calling thread never hands over what it can do itself: its data stay where they are, nobody
/// has to wake it, and items near either end mostly meet the same processor core again.
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
    let queue = Mutex::new(items);
    // Only `next` runs under the lock; where it panicked there is nothing half done.
    let locked = || queue.lock().unwrap_or_else(PoisonError::into_inner);
    let first = || locked().next();
    let last = || locked().next_back();
    rayon::in_place_scope(|scope| {
        for worker in others {
            scope.spawn(|_| {
                while let Some(item) = last() {
                    body(worker, item);
                }
            });
        }
        while let Some(item) = first() {
            body(own, item);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::for_each;

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
}
