//! Which columns have nothing left but rounding error.

use super::Pattern;

/// A column left with no more than this part of its original largest entry is rounding error.
const LEVEL: f64 = 64.0 * f64::EPSILON;

/// What counts as zero in any matrix.
const SMALL: f64 = 1e-20;

/// Tells rounding error from small numbers, by the largest original entry of a column.
///
/// Those are found the first time a column is suspected at all.
#[derive(Debug)]
pub(super) struct Noise<'a> {
    pub pattern: &'a Pattern,
    pub values: &'a [f64],
    /// Below this no column of the matrix can be told from rounding error at once.
    pub suspected: f64,
    /// Largest entry of each column; empty until the first suspicion.
    pub largest: &'a mut Vec<f64>,
}

/// From the largest entry of the whole matrix to what is suspected.
pub(super) fn suspected(largest: f64) -> f64 {
    (LEVEL * largest).max(SMALL)
}

impl Noise<'_> {
    /// Whether a column of this unknown with this largest entry left is zero.
    #[inline(always)]
    pub(super) fn is(&mut self, unknown: u32, left: f64) -> bool {
        left <= self.suspected && self.look(unknown, left)
    }

    #[cold]
    fn look(&mut self, unknown: u32, left: f64) -> bool {
        if self.largest.is_empty() {
            self.largest.resize(self.pattern.len(), 0.0);
            for ((i, j), value) in self.pattern.entries().zip(self.values) {
                self.largest[i] = self.largest[i].max(value.abs());
                self.largest[j] = self.largest[j].max(value.abs());
            }
        }
        left <= (LEVEL * self.largest[unknown as usize]).max(SMALL)
    }
}
