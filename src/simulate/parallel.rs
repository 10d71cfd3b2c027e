//! Independent pieces of work on all processors.

use crate::nlp::threads::{self, for_each};

/// `work` for 0 to `count`, several at a time; results in that order.
pub(super) fn in_order<T: Send>(count: usize, work: &(impl Fn(usize) -> T + Sync)) -> Vec<T> {
    let mut results: Vec<Option<T>> = (0..count).map(|_| None).collect();
    let mut workers = vec![(); threads::count().min(count)];
    for_each(
        &mut workers,
        results.iter_mut().enumerate(),
        |(), (index, result)| *result = Some(work(index)),
    );
    results.into_iter().flatten().collect()
}
