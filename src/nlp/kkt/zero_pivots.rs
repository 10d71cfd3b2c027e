//! Zero pivots: which columns hold nothing but rounding error.

use super::Pattern;

/// A column counts as zero where what is left of it is below this part of its largest entry in the
/// matrix.
const RELATIVE: f64 = 64.0 * f64::EPSILON;

/// A column counts as zero where what is left of it is below this, in any matrix.
const ABSOLUTE: f64 = 1e-20;

/// Tells columns of rounding error from columns of small numbers.
///
/// The exact test compares with the largest entry of the column in the matrix. Those are found only
/// when a column first fails the cheap test against the largest entry of the whole matrix.
#[derive(Debug)]
pub(super) struct ZeroTest<'a> {
    pub pattern: &'a Pattern,
    pub values: &'a [f64],
    /// See [`screen`].
    pub screen: f64,
    /// Largest entry of each column of the matrix; empty until it is needed.
    pub largest: &'a mut Vec<f64>,
}

/// No column with a larger entry than this is zero, in a matrix with this largest entry.
pub(super) fn screen(largest: f64) -> f64 {
    (RELATIVE * largest).max(ABSOLUTE)
}

impl ZeroTest<'_> {
    /// Whether the column of `unknown` is zero, `left` being its largest entry now.
    #[inline(always)]
    pub(super) fn is_zero(&mut self, unknown: u32, left: f64) -> bool {
        left <= self.screen && self.is_zero_in_its_column(unknown, left)
    }

    #[cold]
    fn is_zero_in_its_column(&mut self, unknown: u32, left: f64) -> bool {
        if self.largest.is_empty() {
            self.largest.resize(self.pattern.len(), 0.0);
            for ((i, j), value) in self.pattern.entries().zip(self.values) {
                self.largest[i] = self.largest[i].max(value.abs());
                self.largest[j] = self.largest[j].max(value.abs());
            }
        }
        left <= (RELATIVE * self.largest[unknown as usize]).max(ABSOLUTE)
    }
}
