//! What the starts of a search ended at, and when there are enough.

use super::findings::HELD;
use crate::planner::StartCounts;
use crate::refine::{Outcome, Start};

/// Relative gain that counts as better.
const GAIN: f64 = 5e-3;
/// Relative difference below which two starts ended at the same excess.
const SAME: f64 = 1e-6;
/// Largest error (28) beyond which the solution on one mesh says nothing of a motion.
pub(super) const GROSS: f64 = 1.0;
/// Starts with such an error, before any other, after which a search is given up.
const GROSS_STARTS: usize = 3;

/// From where a search looks, and how closely.
#[derive(Clone, Copy)]
pub(super) struct Look {
    /// What the random numbers of its starts begin with.
    pub seed: u64,
    /// By how much limits are tighter than those of the problem.
    pub tighter: f64,
    /// Weights of the control, and into how many each segment of the first mesh is cut.
    pub searched: &'static [(f64, usize)],
    /// How many times the weight of the search the first of the refinement is at most: what was found on
    /// a coarse mesh is hardly a motion yet.
    pub first_weight: f64,
    /// Starts at most.
    pub starts: usize,
    /// Starts in a row without a better result, or from the first without any, after which it ends.
    pub patience: usize,
}

impl Look {
    /// Whether the amounts `excess` are within the problem's own limits.
    pub fn is_held(&self, excess: f64) -> bool {
        excess < self.tighter + HELD
    }

    /// Whether a start that ends at `excess` on a coarse mesh makes others needless: with tighter limits
    /// it may still be one that no finer mesh confirms.
    pub fn ends_at(&self, excess: f64) -> bool {
        self.tighter == 0.0 && self.is_held(excess)
    }
}

/// Where one start ended.
pub(super) struct Candidate {
    /// The control's weight of its search.
    pub part: f64,
    /// The sum of the amounts by which limits are exceeded.
    pub excess: f64,
    /// The largest error (28).
    error: f64,
    /// The trajectory with the amounts among its static parameters, and its multipliers.
    pub start: Start,
}

impl Candidate {
    fn is_gross(&self) -> bool {
        self.error.is_nan() || self.error >= GROSS
    }

    /// Motions before what is none, then the least excess.
    pub fn order(&self, other: &Self) -> std::cmp::Ordering {
        let gross = self.is_gross().cmp(&other.is_gross());
        gross.then(self.excess.total_cmp(&other.excess))
    }
}

/// What the starts came to so far.
pub(super) struct Candidates {
    /// Every start that was solved, the least excess first.
    pub found: Vec<Candidate>,
    pub starts: StartCounts,
    /// Starts since the last gain.
    stale: usize,
    look: Look,
}

impl Candidates {
    pub fn new(look: Look) -> Self {
        Self {
            found: Vec::new(),
            starts: StartCounts::default(),
            stale: 0,
            look,
        }
    }

    /// Adds what a start with the weight `part` of the control ended at, its amounts being `excess`, where
    /// it was solved; whether the search may end.
    pub fn add(&mut self, part: f64, outcome: &Outcome, excess: f64) -> bool {
        self.starts.tried += 1;
        if !outcome.status.is_solved() {
            return self.found.is_empty() && self.starts.tried == self.look.patience;
        }
        self.starts.feasible += 1;
        let least = self
            .found
            .first()
            .map_or(f64::INFINITY, |least| least.excess);
        self.stale = match excess < least * (1.0 - GAIN) {
            true => 0,
            false => self.stale + 1,
        };
        let same = |other: &Candidate| (other.excess - excess).abs() <= SAME * excess;
        if self.found.iter().any(same) {
            return self.look.ends_at(excess) || self.stale == self.look.patience;
        }
        let place = self.found.partition_point(|other| other.excess <= excess);
        let error = outcome.max_error();
        let candidate = Candidate {
            part,
            excess,
            error,
            start: Start {
                trajectory: outcome.trajectory.clone(),
                iterate: Some(outcome.iterate.clone()),
            },
        };
        self.found.insert(place, candidate);
        let gross = self.found.iter().all(Candidate::is_gross);
        if gross && self.found.len() >= GROSS_STARTS {
            return true;
        }
        self.look.ends_at(excess) || self.stale == self.look.patience
    }
}
