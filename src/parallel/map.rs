//! A function of every index, several at a time.

use super::{for_each, thread_count};

/// `work` of each index below `count`, with the results in the order of the indices.
pub(crate) fn map<T: Send>(count: usize, work: &(impl Fn(usize) -> T + Sync)) -> Vec<T> {
    let mut results: Vec<Option<T>> = (0..count).map(|_| None).collect();
    let mut workers = vec![(); thread_count().min(count)];
    for_each(
        &mut workers,
        results.iter_mut().enumerate(),
        |(), (index, result)| *result = Some(work(index)),
    );
    results.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::map;
    use crate::parallel::with_threads;
    use std::num::NonZero;

    #[test]
    fn results_come_in_the_order_of_the_indices() {
        for threads in 1..4 {
            let squares = with_threads(NonZero::new(threads).unwrap(), || map(20, &|i| i * i));
            assert!(
                squares
                    .iter()
                    .enumerate()
                    .all(|(i, &square)| square == i * i)
            );
            assert_eq!(squares.len(), 20);
        }
        assert!(map(0, &|i| i).is_empty());
    }
}
