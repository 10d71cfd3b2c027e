//! One step of the dynamic programme, by wide vectors.

use super::grid::{Grid, MOVES, stride};
use super::ranges::Ranges;
use crate::autodiff::Kernel;
use std::ops::Range;

/// Area in cells that lies, at most, between a path and its steps on the grid, by how many joints
/// move in the step.
const AREA: [f64; 3] = [1.0, 1.25, 1.5];

/// A step: the ranges `new` after it, from the `old` ones.
pub(super) struct Step<'a> {
    pub grid: &'a Grid,
    pub old: &'a Ranges,
    pub new: &'a mut Ranges,
    /// Rows and columns that matter.
    pub on_the_way: [Range<usize>; 2],
    /// The largest base attitude at every angle, rad.
    pub most: &'a [f64],
    /// 1 for a bound, 0 for an estimate.
    pub certain: f64,
}

impl Kernel for Step<'_> {
    #[inline(always)]
    fn run(self) {
        let Self {
            grid,
            old,
            new,
            on_the_way: [rows, columns],
            most,
            certain,
        } = self;
        let stride = stride(grid.size);
        for i in 1..=grid.size[0] {
            new.clear(i);
            let near = old.near(i);
            let columns = near.start.max(columns.start)..near.end.min(columns.end);
            if !rows.contains(&i) || columns.is_empty() {
                continue;
            }
            let count = columns.len();
            let first = i * stride + columns.start;
            let own = first..first + count;
            // The same angles in the rows before, of and after this one, and one on either side.
            let old = [&old.low, &old.high].map(|all| Three::around(all, stride, first, count));
            let turn = [0, 1, 2, 3].map(|m| Three::around(&grid.turn[m], stride, first, count));
            let area = (&grid.per_cell[own.clone()], certain);
            row(old, turn, area, &most[own], new.write(i, columns));
            new.trim(i);
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
    /// Those around the `count` numbers from `first` on, in rows of `stride`.
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
