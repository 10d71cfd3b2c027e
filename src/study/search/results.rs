//! Results of starts that run at the same time, each seen by later starts alone.

use super::optimum::{Ended, distinct};
use crate::planner::PlanError;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// What a start ended at; nothing where it was not solved.
type Result = std::result::Result<Option<Ended>, PlanError>;

/// The results of all starts. Start k sees those of the starts up to k − [`LAG`](Self::LAG), less those that
/// are slow, no more and no less, so that what it does is the same however many starts run at the same
/// time.
pub(super) struct Results {
    state: Mutex<State>,
    changed: Condvar,
    /// The next start.
    next: AtomicUsize,
    /// The first start that asks for what others found.
    asking: usize,
    /// How many of the best it is told.
    few: usize,
}

#[derive(Default)]
struct State {
    /// Results that are not counted yet.
    ended: BTreeMap<usize, Result>,
    /// Slow starts that are not counted yet.
    slow: BTreeSet<usize>,
    /// How many starts are counted in `found`, from the first on, slow ones passed over.
    counted: usize,
    /// Distinct optima of these, the best first.
    found: Vec<Ended>,
    solved: usize,
    /// That of the first start which has one.
    error: Option<PlanError>,
    /// What each start will see that has not asked yet.
    seen: BTreeMap<usize, Vec<Ended>>,
}

impl Results {
    /// Starts that do not see each other: as many can run at the same time.
    pub const LAG: usize = 4;
    /// Starts after which the result of a slow one counts.
    const SLOW_LAG: usize = 8;

    /// Starts from `asking` on will ask for the `few` best of what others found.
    pub fn new(asking: usize, few: usize) -> Self {
        Self {
            state: Mutex::default(),
            changed: Condvar::new(),
            next: AtomicUsize::new(0),
            asking,
            few,
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The few best distinct optima that start `index` sees, as soon as all those starts have ended; to be
    /// asked for once.
    pub fn best_before(&self, index: usize) -> Vec<Ended> {
        if index < Self::LAG {
            return Vec::new();
        }
        let mut state = self.lock();
        loop {
            if let Some(seen) = state.seen.remove(&index) {
                return seen;
            }
            let woken = self.changed.wait(state);
            state = woken.unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Runs the next start, and keeps what it came to. Starts begin in their order, so that those which
    /// one waits for are running or have ended. A panic counts as not solved for those that wait, and
    /// goes on.
    pub fn run_next(&self, solve: impl FnOnce(usize) -> Result) {
        let index = self.next.fetch_add(1, Ordering::Relaxed);
        let mut ending = Ending {
            results: self,
            index,
            result: Ok(None),
        };
        ending.result = solve(index);
    }

    /// Start `index`, which still runs, is slow: later ones do not wait for it for now. To be said by what it
    /// did, never by the time that took.
    pub fn mark_slow(&self, index: usize) {
        let mut state = self.lock();
        state.slow.insert(index);
        self.count(&mut state);
    }

    /// Start `index` has ended.
    fn add(&self, index: usize, result: Result) {
        let mut state = self.lock();
        state.ended.insert(index, result);
        self.count(&mut state);
    }

    /// Counts all results up to the first start that is waited for.
    fn count(&self, state: &mut State) {
        loop {
            let next = state.counted;
            let due = |&&index: &&usize| index + Self::SLOW_LAG <= next;
            if let Some(&index) = state.slow.first().filter(due) {
                let Some(result) = state.ended.remove(&index) else {
                    break;
                };
                state.slow.remove(&index);
                state.take(result);
                continue;
            }
            if !state.slow.contains(&next) {
                let Some(result) = state.ended.remove(&next) else {
                    break;
                };
                state.take(result);
            }
            state.counted += 1;
            let sees = state.counted + Self::LAG - 1;
            if sees >= self.asking {
                let best = state.found.iter().take(self.few).cloned().collect();
                state.seen.insert(sees, best);
            }
        }
        self.changed.notify_all();
    }

    /// All distinct optima, the best first, and how many starts were solved.
    ///
    /// # Errors
    /// That of the first start that has one.
    pub fn into_distinct(self) -> std::result::Result<(Vec<Ended>, usize), PlanError> {
        let state = self.state.into_inner();
        let mut state = state.unwrap_or_else(PoisonError::into_inner);
        // Slow ones that no start has waited for.
        for result in std::mem::take(&mut state.ended).into_values() {
            state.take(result);
        }
        match state.error {
            Some(error) => Err(error),
            None => Ok((state.found, state.solved)),
        }
    }
}

impl State {
    /// Counts one result.
    fn take(&mut self, result: Result) {
        match result {
            Ok(ended) => {
                self.solved += usize::from(ended.is_some());
                let found = std::mem::take(&mut self.found);
                self.found = distinct(found, ended);
            }
            Err(error) => {
                self.error.get_or_insert(error);
            }
        }
    }
}

/// Keeps the result of a start when it ends, be it by a panic: others may wait for it.
struct Ending<'r> {
    results: &'r Results,
    index: usize,
    result: Result,
}

impl Drop for Ending<'_> {
    fn drop(&mut self) {
        let result = std::mem::replace(&mut self.result, Ok(None));
        self.results.add(self.index, result);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::Mesh;
    use crate::nlp::Iterate;
    use crate::parallel::{map, with_threads};
    use crate::planner::Start;
    use crate::study::search::Optimum;
    use crate::system::StartKind;
    use crate::transcription::Discretization;
    use std::num::NonZero;

    fn ended(start: usize, objective: f64) -> Ended {
        let mesh = Mesh::uniform(1, 2).unwrap();
        Ended {
            optimum: Optimum {
                objective,
                max_base_attitude: 0.0,
                final_base_attitude: 0.0,
                hits: 1,
                start,
                kind: StartKind::Loop,
                status: None,
            },
            gross: false,
            start: Start {
                trajectory: Discretization::sample(mesh, 1.0, 1, 1, |_, _, _| {}),
                iterate: None::<Iterate>,
            },
        }
    }

    /// Each start is one better than the best that it sees; the first four see nothing.
    #[test]
    fn what_a_start_sees_is_the_same_on_any_number_of_threads() {
        let costs = |threads: usize| {
            let results = Results::new(0, 3);
            with_threads(NonZero::new(threads).unwrap(), || {
                map(13, &|_| {
                    results.run_next(|k| {
                        let best = results.best_before(k);
                        let least = best.first().map_or(100.0, |best| best.optimum.objective);
                        Ok((k != 5).then(|| ended(k, least - 1.0)))
                    });
                });
            });
            let (found, solved) = results.into_distinct().unwrap();
            assert_eq!(solved, 12);
            let costs = found
                .iter()
                .map(|one| (one.optimum.start, one.optimum.hits, one.optimum.objective));
            costs.collect::<Vec<_>>()
        };
        let alone = costs(1);
        assert_eq!(alone[0], (12, 1, 96.0));
        for threads in 2..=4 {
            assert_eq!(costs(threads), alone);
        }
    }

    /// Start 1 is slow and better than all; what the others see of it is the same whether it ends before
    /// them or after.
    #[test]
    fn a_slow_start_is_seen_late_and_waited_for_then_alone() {
        let seen = |threads: usize| {
            let results = Results::new(0, 1);
            let least = Mutex::new(BTreeMap::new());
            with_threads(NonZero::new(threads).unwrap(), || {
                map(20, &|_| {
                    results.run_next(|k| {
                        let best = results.best_before(k);
                        let cost = best.first().map_or(100.0, |best| best.optimum.objective);
                        least.lock().unwrap().insert(k, cost);
                        if k == 1 {
                            results.mark_slow(k);
                            // Until others pass by, where there are others.
                            while threads > 1 && least.lock().unwrap().len() < 8 {
                                std::thread::yield_now();
                            }
                        }
                        Ok(Some(ended(k, if k == 1 { 1.0 } else { 50.0 })))
                    });
                });
            });
            let (found, solved) = results.into_distinct().unwrap();
            assert_eq!((solved, found[0].optimum.start), (20, 1));
            least
                .into_inner()
                .unwrap()
                .into_values()
                .collect::<Vec<_>>()
        };
        let alone = seen(1);
        let first = 1 + Results::SLOW_LAG + Results::LAG;
        let expected = |k| match k {
            0..Results::LAG => 100.0,
            k if k < first => 50.0,
            _ => 1.0,
        };
        assert_eq!(alone, (0..20).map(expected).collect::<Vec<_>>());
        assert_eq!(seen(2), alone);
    }

    #[test]
    fn a_panic_leaves_nobody_waiting() {
        let results = Results::new(0, 3);
        let panicked = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            results.run_next(|_| panic!("on purpose"));
        }));
        assert!(panicked.is_err());
        assert!(results.best_before(4).is_empty());
    }
}
