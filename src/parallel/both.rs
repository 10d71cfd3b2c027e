//! Two unlike pieces of work at the same time.

use super::{for_each, thread_count};

/// What `a` and `b` come to; on two threads where there are so many, else one after the other.
pub(crate) fn both<A: Send, B: Send>(
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    let (mut left, mut right) = (None, None);
    let first = || left = Some(a());
    let second = || right = Some(b());
    let pieces: [Box<dyn FnOnce() + Send>; 2] = [Box::new(first), Box::new(second)];
    let mut workers = vec![(); thread_count().min(2)];
    for_each(&mut workers, pieces.into_iter(), |(), piece| piece());
    left.zip(right).expect("both have ended")
}

#[cfg(test)]
mod tests {
    use super::both;
    use crate::parallel::with_threads;
    use std::num::NonZero;

    #[test]
    fn each_result_in_its_place() {
        for threads in 1..4 {
            let threads = NonZero::new(threads).unwrap();
            let found = with_threads(threads, || both(|| 1, || "two".to_string()));
            assert_eq!(found, (1, "two".to_string()));
        }
    }
}
