//! Ranges of the base attitude on the grid.

use super::grid::{Grid, stride};
use std::ops::Range;

/// Lower and upper ends of the base attitude that can be reached at every angle, rad; empty where the
/// lower end is above the upper.
#[derive(Debug, Clone)]
pub(super) struct Ranges {
    /// Numbers from one row to the next.
    stride: usize,
    pub low: Vec<f64>,
    pub high: Vec<f64>,
    /// Columns of every row outside of which all are empty.
    columns: Vec<Range<usize>>,
}

impl Ranges {
    /// Empty ones at all angles of `grid`, and around them.
    pub fn none(grid: &Grid) -> Self {
        let count = grid.per_cell.len();
        let stride = stride(grid.size);
        Self {
            stride,
            low: vec![f64::INFINITY; count],
            high: vec![f64::NEG_INFINITY; count],
            columns: vec![0..0; count / stride],
        }
    }

    /// The one value that there is, at `[row, column]`.
    pub fn begin(&mut self, [row, column]: [usize; 2], value: f64) {
        let at = row * self.stride + column;
        (self.low[at], self.high[at]) = (value, value);
        self.columns[row] = column..column + 1;
    }

    /// Whether all are empty.
    pub fn are_empty(&self) -> bool {
        self.columns.iter().all(Range::is_empty)
    }

    /// Columns of a row that are next to one that is not empty, or not empty.
    pub fn near(&self, row: usize) -> Range<usize> {
        let rows = &self.columns[row - 1..=row + 1];
        let rows = rows.iter().filter(|columns| !columns.is_empty()).cloned();
        let all = rows.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end));
        all.map_or(0..0, |columns| columns.start - 1..columns.end + 1)
    }

    /// Makes a row empty.
    #[inline(always)]
    pub fn clear(&mut self, row: usize) {
        let columns = std::mem::replace(&mut self.columns[row], 0..0);
        let written = self.numbers(row, columns);
        self.low[written.clone()].fill(f64::INFINITY);
        self.high[written].fill(f64::NEG_INFINITY);
    }

    /// Lower and upper ends in these columns of an empty row, to be written.
    #[inline(always)]
    pub fn write(&mut self, row: usize, columns: Range<usize>) -> (&mut [f64], &mut [f64]) {
        self.columns[row] = columns.clone();
        let numbers = self.numbers(row, columns);
        (&mut self.low[numbers.clone()], &mut self.high[numbers])
    }

    /// Leaves out columns at either end of a row that are empty.
    #[inline(always)]
    pub fn trim(&mut self, row: usize) {
        let first = self.numbers(row, 0..0).start;
        let is_empty = |column: usize| self.low[first + column] > self.high[first + column];
        let Range { mut start, mut end } = self.columns[row].clone();
        while start < end && is_empty(start) {
            start += 1;
        }
        while start < end && is_empty(end - 1) {
            end -= 1;
        }
        self.columns[row] = start..end;
    }

    /// Where these columns of a row stand.
    fn numbers(&self, row: usize, columns: Range<usize>) -> Range<usize> {
        let first = row * self.stride;
        first + columns.start..first + columns.end
    }
}
