//! Results of starts that run at the same time, each seen by later starts alone.

use super::optimum::{Ended, distinct};
use crate::planner::PlanError;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// What a start ended at; nothing where it was not solved.
type Result = std::result::Result<Option<Ended>, PlanError>;

/// The results of all starts. Start k sees those of the starts up to k − [`LAG`](Self::LAG), no more and
/// no less, so that what it does is the same however many starts run at the same time.
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
    /// Results of starts that have ended before one that began earlier.
    early: BTreeMap<usize, Result>,
    /// How many starts are counted in `found`, from the first on.
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

    /// Counts all results up to the first start that still runs.
    fn add(&self, index: usize, result: Result) {
        let mut state = self.lock();
        state.early.insert(index, result);
        while let Some(result) = {
            let next = state.counted;
            state.early.remove(&next)
        } {
            match result {
                Ok(ended) => {
                    state.solved += usize::from(ended.is_some());
                    let found = std::mem::take(&mut state.found);
                    state.found = distinct(found, ended);
                }
                Err(error) => {
                    state.error.get_or_insert(error);
                }
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
        let state = self
            .state
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner);
        match state.error {
            Some(error) => Err(error),
            None => Ok((state.found, state.solved)),
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
