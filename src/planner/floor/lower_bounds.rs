//! How far the base must turn at least, beside what a search finds.

use super::{Certainty, Grid, STEPS, WORK};
use crate::nlp::Deadline;
use crate::numeric::largest_or_nan;
use crate::problem::Problem;
use crate::system::straight_motion;

/// Accuracy of the bound on the largest base angle, as a part of it.
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
    /// Those of `problem`; that on the largest base angle is at most what it is along the straight path.
    ///
    /// `None` unless the arm is planar with two joints whose rates are limited, goes to a given goal in a
    /// limited time, and the system has no momentum; or where `deadline` passes.
    pub(crate) fn new(problem: &Problem, deadline: Deadline) -> Option<Self> {
        if deadline.has_passed() {
            return None;
        }
        let grid = Grid::new(problem, WORK)?;
        let [low, high] = grid.reachable(f64::INFINITY, Certainty::Bound);
        if low > high || deadline.has_passed() {
            return None;
        }
        let at_end = low.max(-high).max(0.0);
        let straight = straight_motion(problem, problem.task.duration.center(), STEPS);
        let most = largest_or_nan(straight.base_attitude.iter().map(|x| x[0].abs()));
        let least = problem.task.initial_base_attitude[0].abs().max(at_end);
        let between = [least.min(most), most];
        Some(Self {
            max_base_attitude: grid.smallest_bound(between, ACCURACY, Certainty::Bound),
            final_base_attitude: at_end,
        })
    }
}
