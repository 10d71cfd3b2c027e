//! What candidates come to on their way to finer meshes, each seen by later ones alone.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, PoisonError};

/// Relative difference of J that two candidates may have on their second mesh and yet be the same: there
/// J was within 1.2e-4 of what it is on the last.
const ALIKE: f64 = 3e-4;

/// Candidates that are refined at the same time. One goes on while it is better than what earlier ones
/// came to, whatever later ones do: what is refined to the end is the same however many run at a time.
#[derive(Debug)]
pub(super) struct Rivals {
    /// What each candidate came to; nothing where it is not known yet.
    costs: Mutex<Vec<Option<f64>>>,
    changed: Condvar,
    /// The next candidate.
    next: AtomicUsize,
    /// What has to be beaten by all of them.
    least: f64,
}

/// One of them.
#[derive(Debug)]
pub(super) struct Rival<'r> {
    rivals: &'r Rivals,
    index: usize,
    is_told: bool,
}

/// Whether a candidate of cost `cost` will come to less than one of cost `least`.
pub(super) fn is_better(cost: f64, least: f64) -> bool {
    least == f64::INFINITY || cost < least - ALIKE * least.abs()
}

/// Whether it may come to less.
fn may_be_better(cost: f64, least: f64) -> bool {
    least == f64::INFINITY || cost < least + ALIKE * least.abs()
}

impl Rivals {
    /// So many candidates, to be better than `least`, which may be infinite.
    pub fn new(count: usize, least: f64) -> Self {
        Self {
            costs: Mutex::new(vec![None; count]),
            changed: Condvar::new(),
            next: AtomicUsize::new(0),
            least,
        }
    }

    /// The next candidate. They begin in their order, so that those which one waits for are running or
    /// have ended.
    pub fn begin_next(&self) -> Rival<'_> {
        Rival {
            rivals: self,
            index: self.next.fetch_add(1, Ordering::Relaxed),
            is_told: false,
        }
    }
}

impl Rival<'_> {
    /// Which candidate it is, counted from 0.
    pub fn index(&self) -> usize {
        self.index
    }

    /// Whether it goes on with `cost` on the way: where it will come to less than all earlier ones, or may
    /// and `has_to_be_seen`. Waits for theirs.
    pub fn goes_on(&mut self, cost: f64, has_to_be_seen: bool) -> bool {
        self.tell(cost);
        let costs = self.rivals.costs.lock();
        let mut costs = costs.unwrap_or_else(PoisonError::into_inner);
        loop {
            let earlier: Option<Vec<f64>> = costs[..self.index].iter().copied().collect();
            if let Some(earlier) = earlier {
                let least = earlier.into_iter().fold(self.rivals.least, f64::min);
                return match has_to_be_seen {
                    true => may_be_better(cost, least),
                    false => is_better(cost, least),
                };
            }
            let woken = self.rivals.changed.wait(costs);
            costs = woken.unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// What it came to; the first that is told counts.
    pub fn tell(&mut self, cost: f64) {
        if !std::mem::replace(&mut self.is_told, true) {
            let costs = self.rivals.costs.lock();
            costs.unwrap_or_else(PoisonError::into_inner)[self.index] = Some(cost);
            self.rivals.changed.notify_all();
        }
    }
}

impl Drop for Rival<'_> {
    /// One that ended, be it by a panic, before it could tell is nothing to be beaten.
    fn drop(&mut self) {
        self.tell(f64::INFINITY);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parallel::{map, with_threads};
    use std::num::NonZero;

    #[test]
    fn those_go_on_that_are_better_than_all_before_them_on_any_number_of_threads() {
        let costs = [2.0, 3.0, 1.9999, f64::NAN, 1.0, 1.5, 0.5];
        let winners = |threads, least, seen| {
            let rivals = Rivals::new(costs.len(), least);
            let mut ended = with_threads(NonZero::new(threads).unwrap(), || {
                map(costs.len(), &|_| {
                    let mut rival = rivals.begin_next();
                    let cost = costs[rival.index()];
                    (rival.index(), cost.is_nan() || rival.goes_on(cost, seen))
                })
            });
            ended.sort_unstable();
            ended.into_iter().map(|(_, won)| won).collect::<Vec<_>>()
        };
        for threads in 1..4 {
            let all = winners(threads, f64::INFINITY, false);
            assert_eq!(all, [true, false, false, true, true, false, true]);
            let all = winners(threads, f64::INFINITY, true);
            assert_eq!(all, [true, false, true, true, true, false, true]);
            let below_one = winners(threads, 0.9, false);
            assert_eq!(below_one, [false, false, false, true, false, false, true]);
        }
    }

    #[test]
    fn a_panic_leaves_nobody_waiting() {
        let rivals = Rivals::new(2, f64::INFINITY);
        let panicked = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            let _first = rivals.begin_next();
            panic!("on purpose");
        }));
        assert!(panicked.is_err());
        assert!(rivals.begin_next().goes_on(1.0, false));
    }
}
