//! How little the base can turn: dynamic programming over the steps on the grid.

use super::grid::{Grid, place, stride};
use super::ranges::Ranges;
use super::step::Step;
use crate::autodiff;
use std::ops::Range;

/// Part of the largest bound below which bounds are not told apart as well.
const SMALLEST: f64 = 0.1;

/// What a dynamic programme's result is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Certainty {
    /// That of the motions on the grid.
    Estimate,
    /// That of all motions: at every step the base may turn by what lies between the grid and a path
    /// beside it.
    Bound,
}

impl Grid {
    /// Base attitudes that can be reached at the goal with |η| ≤ `bound` all along, rad; lower
    /// above upper where none can.
    pub fn reachable(&self, bound: f64, certainty: Certainty) -> [f64; 2] {
        let certain = f64::from(certainty == Certainty::Bound);
        let most = self.nearby.iter().map(|turn| bound + certain * turn);
        let most: Vec<f64> = most.collect();
        let mut range = Ranges::none(self);
        let mut next = range.clone();
        range.begin(self.start.map(|i| i + 1), self.ends[0]);
        for done in 1..=self.steps {
            autodiff::dispatch(Step {
                grid: self,
                old: &range,
                new: &mut next,
                on_the_way: [0, 1].map(|joint| self.on_the_way(joint, done)),
                most: &most,
                certain,
            });
            std::mem::swap(&mut range, &mut next);
            if range.are_empty() {
                break;
            }
        }
        let goal = place(stride(self.size), self.goal);
        let [low, high] = [&range.low, &range.high].map(|range| range[goal] + self.ends[1]);
        [low.max(-bound), high.min(bound)]
    }

    /// Rows or columns of the angles of a joint that lie on some way from the start to the goal with so
    /// many steps `done`. No others matter.
    fn on_the_way(&self, joint: usize, done: usize) -> Range<usize> {
        let (start, goal, size) = (self.start[joint], self.goal[joint], self.size[joint]);
        let left = self.steps - done;
        let first = start.saturating_sub(done).max(goal.saturating_sub(left));
        let end = size.min(start + done + 1).min(goal + left + 1);
        first + 1..end + 1
    }

    /// Smallest bound on |η| along the path, t_f included, within `between` for which the goal can be
    /// reached, rad; to `accuracy`, a part of it, or of a tenth of the upper end where it is less.
    pub fn smallest_bound(&self, between: [f64; 2], accuracy: f64, certainty: Certainty) -> f64 {
        let [mut low, mut high] = between;
        let smallest = SMALLEST * high;
        while high - low > accuracy * high.max(smallest) {
            let middle = 0.5 * (low + high);
            let [least, most] = self.reachable(middle, certainty);
            match least <= most {
                true => high = middle,
                false => low = middle,
            }
        }
        match certainty {
            Certainty::Estimate => high,
            Certainty::Bound => low,
        }
    }
}
