//! How little the base can turn: dynamic programming over the steps on the grid.

use super::grid::{Grid, MOVES, place, stride};
use crate::autodiff::{self, Kernel};
use crate::parallel;
use std::ops::Range;

/// Area in cells that lies, at most, between a path and its steps on the grid, by how many joints
/// move in the step.
const AREA: [f64; 3] = [1.0, 1.25, 1.5];
/// Steps after which it is seen whether anything is left.
const LOOK: usize = 16;

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
        let mut range = Ranges::none(self.per_cell.len());
        let mut next = range.clone();
        let stride = stride(self.size);
        range.set(place(stride, self.start), self.ends[0]);
        for done in 1..=self.steps {
            autodiff::dispatch(Step {
                grid: self,
                done,
                range: &range,
                next: &mut next,
                most: &most,
                certain,
            });
            std::mem::swap(&mut range, &mut next);
            if done % LOOK == 0 && range.are_empty() {
                break;
            }
        }
        let goal = place(stride, self.goal);
        let [low, high] = [&range.low, &range.high].map(|range| range[goal] + self.ends[1]);
        [low.max(-bound), high.min(bound)]
    }

    /// Angles of one joint, counted from the first, that lie on some way from the start to the goal with
    /// so many steps `done`. No others matter.
    fn on_the_way(&self, joint: usize, done: usize) -> Range<usize> {
        let (start, goal, size) = (self.start[joint], self.goal[joint], self.size[joint]);
        let left = self.steps - done;
        let first = start.saturating_sub(done).max(goal.saturating_sub(left));
        first..size.min(start + done + 1).min(goal + left + 1)
    }

    /// Smallest bound on |η| along the path, t_f included, between `low` and `high` for which the
    /// goal can be reached, to `accuracy`; rad.
    pub fn smallest_bound(&self, between: [f64; 2], accuracy: f64, certainty: Certainty) -> f64 {
        let [mut low, mut high] = between;
        while high - low > accuracy {
            // Two at a time, for two threads.
            let third = (high - low) / 3.0;
            let bounds = [low + third, high - third];
            let works = |k: usize| {
                let [least, most] = self.reachable(bounds[k], certainty);
                least <= most
            };
            let first = match parallel::thread_count() {
                1 => (0..2).find(|&k| works(k)),
                _ => parallel::map(2, &works).into_iter().position(|works| works),
            };
            [low, high] = match first {
                Some(0) => [low, bounds[0]],
                Some(_) => bounds,
                None => [bounds[1], high],
            };
        }
        match certainty {
            Certainty::Estimate => high,
            Certainty::Bound => low,
        }
    }
}

/// A step: the ranges `next` after `done` steps, from those before, within ±`most` at every angle.
struct Step<'a> {
    grid: &'a Grid,
    done: usize,
    range: &'a Ranges,
    next: &'a mut Ranges,
    most: &'a [f64],
    /// 1 for a bound, 0 for an estimate.
    certain: f64,
}

impl Kernel for Step<'_> {
    #[inline(always)]
    fn run(self) {
        let Self {
            grid,
            done,
            range,
            next,
            most,
            certain,
        } = self;
        next.clear();
        let columns = grid.on_the_way(1, done);
        if columns.is_empty() {
            return;
        }
        let count = columns.len();
        let stride = stride(grid.size);
        for i in grid.on_the_way(0, done) {
            let first = place(stride, [i, columns.start]);
            let own = first..first + count;
            let new = (&mut next.low[own.clone()], &mut next.high[own.clone()]);
            // The same angles in the rows before, of and after this one, and one on either side.
            let old = [&range.low, &range.high].map(|all| Three::around(all, stride, first, count));
            let turn = [0, 1, 2, 3].map(|m| Three::around(&grid.turn[m], stride, first, count));
            let area = (&grid.per_cell[own.clone()], certain);
            row(old, turn, area, &most[own], new);
        }
    }
}

/// Parts of three rows of numbers at every angle, with one more on either side.
#[derive(Clone, Copy)]
struct Three<'a> {
    before: &'a [f64],
    own: &'a [f64],
    after: &'a [f64],
}

impl<'a> Three<'a> {
    /// Those around the `count` numbers from `first` on.
    #[inline(always)]
    fn around(all: &'a [f64], stride: usize, first: usize, count: usize) -> Self {
        let part = |first: usize| &all[first - 1..][..count + 2];
        Self {
            before: part(first - stride),
            own: part(first),
            after: part(first + stride),
        }
    }
}

/// One row of the ranges `low` and `high` after a step, from the `old` ones, lower and upper ends, around
/// it.
#[inline(always)]
fn row(
    [lower, upper]: [Three<'_>; 2],
    turn: [Three<'_>; 4],
    (per_cell, certain): (&[f64], f64),
    most: &[f64],
    (low, high): (&mut [f64], &mut [f64]),
) {
    const { assert!(matches!(MOVES, [[0, 1], [1, 0], [1, 1], [1, -1]])) };
    let count = low.len();
    let (high, per_cell, most) = (&mut high[..count], &per_cell[..count], &most[..count]);
    let long = count + 2;
    let [lower, upper] =
        [lower, upper].map(|of| [of.before, of.own, of.after].map(|row| &row[..long]));
    let turn = turn.map(|of| [of.own, of.after].map(|row| &row[..long]));
    for j in 0..count {
        // One angle further on in a row with numbers on either side.
        let (left, k, right) = (j, j + 1, j + 2);
        let cell = certain * per_cell[j];
        let from =
            |row: usize, at: usize, turn: f64| [lower[row][at] + turn, upper[row][at] + turn];
        let stay = from(1, k, 0.0);
        let one_joint = [
            from(1, left, turn[0][0][k]),
            from(1, right, -turn[0][0][right]),
            from(0, k, turn[1][0][k]),
            from(2, k, -turn[1][1][k]),
        ];
        let both_joints = [
            from(0, left, turn[2][0][k]),
            from(2, right, -turn[2][1][right]),
            from(0, right, turn[3][0][k]),
            from(2, left, -turn[3][1][left]),
        ];
        let mut ends = widened(stay, AREA[0] * cell);
        ends = around(ends, widened(around_all(one_joint), AREA[1] * cell));
        ends = around(ends, widened(around_all(both_joints), AREA[2] * cell));
        let [mut least, mut highest] = ends;
        // What is left of it within ±most.
        let most = most[j];
        let within = (least <= most) & (highest >= -most);
        least = if least < -most { -most } else { least };
        highest = if highest > most { most } else { highest };
        low[j] = if within { least } else { f64::INFINITY };
        high[j] = if within { highest } else { f64::NEG_INFINITY };
    }
}

/// The range that holds both.
#[inline(always)]
fn around(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    // Comparisons become vector instructions, `min` and `max` of a NaN do not.
    let low = if b[0] < a[0] { b[0] } else { a[0] };
    let high = if b[1] > a[1] { b[1] } else { a[1] };
    [low, high]
}

/// The range that holds all four.
#[inline(always)]
fn around_all([a, b, c, d]: [[f64; 2]; 4]) -> [f64; 2] {
    around(around(a, b), around(c, d))
}

/// The range with so much more on either side.
#[inline(always)]
fn widened([low, high]: [f64; 2], by: f64) -> [f64; 2] {
    [low - by, high + by]
}

/// The range of base attitudes at every angle, rad; empty where the lower end is above the upper.
#[derive(Debug, Clone)]
struct Ranges {
    low: Vec<f64>,
    high: Vec<f64>,
}

impl Ranges {
    fn none(count: usize) -> Self {
        Self {
            low: vec![f64::INFINITY; count],
            high: vec![f64::NEG_INFINITY; count],
        }
    }

    fn clear(&mut self) {
        self.low.fill(f64::INFINITY);
        self.high.fill(f64::NEG_INFINITY);
    }

    fn set(&mut self, at: usize, value: f64) {
        (self.low[at], self.high[at]) = (value, value);
    }

    /// Whether there is none at any angle.
    fn are_empty(&self) -> bool {
        let mut ends = self.low.iter().zip(&self.high);
        ends.all(|(low, high)| low > high)
    }
}
