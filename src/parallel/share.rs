//! Threads that large items of work divide among themselves.

use super::{Chosen, map, thread_count, with};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What the items of one [`map_sharing`] know of each other.
#[derive(Debug, Clone)]
pub(super) struct Share {
    threads: usize,
    /// Items that have not ended.
    left: Arc<AtomicUsize>,
}

impl Share {
    /// The threads of one item at this moment.
    pub fn now(&self) -> usize {
        let left = self.left.load(Ordering::Relaxed);
        (self.threads / left.max(1)).max(1)
    }

    /// Those of the last item.
    pub fn most(&self) -> usize {
        self.threads
    }
}

/// [`map`] for few items that take long, and unequally long: once fewer are left than there are threads,
/// each of them has several.
pub(crate) fn map_sharing<T: Send>(count: usize, work: &(impl Fn(usize) -> T + Sync)) -> Vec<T> {
    let share = Share {
        threads: thread_count(),
        left: Arc::new(AtomicUsize::new(count)),
    };
    map(count, &|index| {
        let result = with(Chosen::Shared(share.clone()), || work(index));
        share.left.fetch_sub(1, Ordering::Relaxed);
        result
    })
}

#[cfg(test)]
mod tests {
    use super::{Share, map_sharing};
    use crate::parallel::{most_threads, thread_count, with_threads};
    use std::num::NonZero;
    use std::sync::Arc;
    use std::sync::atomic::AtomicUsize;

    #[test]
    fn the_fewer_items_are_left_the_more_threads_each_has() {
        let threads = |left| {
            let left = Arc::new(AtomicUsize::new(left));
            Share { threads: 5, left }.now()
        };
        assert_eq!([9, 5, 3, 2, 1].map(threads), [1, 1, 1, 2, 5]);
    }

    #[test]
    fn an_item_alone_has_all_threads_and_they_are_given_back() {
        let both = |_| [thread_count(), most_threads()];
        with_threads(NonZero::new(8).unwrap(), || {
            assert_eq!(map_sharing(1, &both), [[8, 8]]);
            assert!(map_sharing(20, &both).iter().all(|[_, most]| *most == 8));
            assert_eq!(both(0), [8, 8]);
        });
        let alone = with_threads(NonZero::<usize>::MIN, || map_sharing(3, &both));
        assert_eq!(alone, [[1, 1]; 3]);
    }
}
