//! Results of starts that run at the same time, each seen by later starts alone.

use super::optimum::{Ended, distinct};
use crate::planner::PlanError;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// What a start ended at; nothing where it was not solved.
type Result = std::result::Result<Option<Ended>, PlanError>;

/// The results of so many starts. Start k sees those of the starts up to k − [`LAG`](Self::LAG), no more
/// and no less, so that what it does is the same however many starts run at the same time.
pub(super) struct Results {
    of: Mutex<Vec<Option<Result>>>,
    changed: Condvar,
    /// The next start.
    next: AtomicUsize,
}

impl Results {
    /// Starts that do not see each other: as many can run at the same time.
    pub const LAG: usize = 4;

    pub fn new(starts: usize) -> Self {
        Self {
            of: Mutex::new((0..starts).map(|_| None).collect()),
            changed: Condvar::new(),
            next: AtomicUsize::new(0),
        }
    }

    fn lock(&self) -> MutexGuard<'_, Vec<Option<Result>>> {
        self.of.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The `few` best distinct optima that start `index` sees, as soon as all these starts have ended.
    pub fn best_before(&self, index: usize, few: usize) -> Vec<Ended> {
        let seen = (index + 1).saturating_sub(Self::LAG);
        let mut results = self.lock();
        while results[..seen].iter().any(Option::is_none) {
            let woken = self.changed.wait(results);
            results = woken.unwrap_or_else(PoisonError::into_inner);
        }
        let ended = results[..seen].iter().flatten().flatten().flatten();
        let mut best = distinct(Vec::new(), ended.cloned());
        best.truncate(few);
        best
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

    /// All distinct optima, the best first, and how many starts were solved.
    ///
    /// # Errors
    /// That of the first start that has one.
    pub fn into_distinct(self) -> std::result::Result<(Vec<Ended>, usize), PlanError> {
        let results = self.of.into_inner().unwrap_or_else(PoisonError::into_inner);
        let solved: Vec<Option<Ended>> = results
            .into_iter()
            .flatten()
            .collect::<std::result::Result<_, _>>()?;
        let solved: Vec<Ended> = solved.into_iter().flatten().collect();
        let count = solved.len();
        Ok((distinct(Vec::new(), solved), count))
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
        self.results.lock()[self.index] = Some(result);
        self.results.changed.notify_all();
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
            let results = Results::new(13);
            with_threads(NonZero::new(threads).unwrap(), || {
                map(13, &|_| {
                    results.run_next(|k| {
                        let best = results.best_before(k, 3);
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
        assert_eq!(alone[0], (11, 1, 97.0));
        for threads in 2..=4 {
            assert_eq!(costs(threads), alone);
        }
    }

    #[test]
    fn a_panic_leaves_nobody_waiting() {
        let results = Results::new(5);
        let panicked = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            results.run_next(|_| panic!("on purpose"));
        }));
        assert!(panicked.is_err());
        assert!(results.best_before(4, 3).is_empty());
    }
}
