//! How far the base must turn at least, beside what a search found.

use super::{Certainty, Grid, WORK};
use crate::nlp::Deadline;
use crate::parallel;
use crate::problem::Problem;

/// Accuracy of the bound on the largest base angle, as a part of that which was found.
const ACCURACY: f64 = 0.015;

/// What no motion of a planar arm with two joints can do better than, by its momentum, its largest rates
/// and the range of its joints alone.
///
/// Bounds, not estimates: the best motion turns the base as far or farther. Limits on accelerations
/// and torques, obstacles and way-points are left out.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LowerBounds {
    /// The largest base angle along the path, rad.
    pub max_base_attitude: f64,
    /// The base angle at t_f, rad.
    pub final_base_attitude: f64,
}

impl LowerBounds {
    /// Those of `problem`, for which a motion was found whose largest base angle is `found`, rad.
    ///
    /// `None` unless the arm is planar with two joints whose rates are limited, goes to a given goal in a
    /// limited time, and the system has no momentum; or where `deadline` passes.
    pub(crate) fn new(problem: &Problem, found: f64, deadline: Deadline) -> Option<Self> {
        if deadline.has_passed() {
            return None;
        }
        let grid = Grid::new(problem, WORK)?;
        let start = problem.task.initial_base_attitude[0].abs().min(found);
        // Of all motions and, at the same time, of those within the middle of what is to be searched.
        let bounds = [f64::INFINITY, 0.5 * (start + found)];
        let ranges = parallel::map(2, &|k| grid.reachable(bounds[k], Certainty::Bound));
        let ([low, high], [least, most]) = (ranges[0], ranges[1]);
        if low > high || deadline.has_passed() {
            return None;
        }
        let at_end = low.max(-high).max(0.0);
        let half = match least <= most {
            true => [start, bounds[1]],
            false => [bounds[1], found],
        };
        let between = [half[0].max(at_end).min(half[1]), half[1]];
        Some(Self {
            max_base_attitude: grid.smallest_bound(between, ACCURACY * found, Certainty::Bound),
            final_base_attitude: at_end,
        })
    }
}
