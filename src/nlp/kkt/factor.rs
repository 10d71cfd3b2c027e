//! Numerical factorisation, subtree by subtree.

use super::partition::MAX_SUBTREES;
use super::scaling::Scaling;
use super::subtree::{Inertia, Matrix, Subtree};
use super::symbolic::Symbolic;
use super::update::largest_finite;
use super::zero_pivots;
use crate::parallel;

/// The matrix has a value that is infinite or not a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the matrix has a value that is not finite")]
pub struct NotFinite;

/// The factors of a matrix, and the memory to make them.
#[derive(Debug, Clone, Default)]
pub struct Factors {
    /// As `Symbolic::subtrees`.
    pub(super) subtrees: Vec<Subtree>,
    /// Right-hand side of one front.
    pub(super) vector: Vec<f64>,
    /// The scaling of the matrix, where it is scaled.
    pub(super) scaling: Scaling,
    pub(super) is_scaled: bool,
}

impl Factors {
    /// Memory for matrices of this pattern; delayed pivots may make it grow.
    pub fn new(symbolic: &Symbolic) -> Self {
        let sizes = symbolic.subtrees.iter();
        Self {
            subtrees: sizes
                .map(|size| Subtree::new(size, symbolic.len()))
                .collect(),
            vector: Vec::new(),
            scaling: Scaling::default(),
            is_scaled: false,
        }
    }

    /// The same as [`Self::factor`], of the matrix scaled to columns of one size: pivots are then
    /// compared with what belongs to them, and fewer are delayed.
    ///
    /// Inertia and solutions are those of the matrix as it is.
    ///
    /// # Errors
    /// As [`Self::factor`].
    ///
    /// # Panics
    /// As [`Self::factor`].
    pub fn factor_scaled(
        &mut self,
        symbolic: &Symbolic,
        values: &[f64],
        threshold: f64,
    ) -> Result<Inertia, NotFinite> {
        assert_eq!(values.len(), symbolic.pattern.nonzeros());
        largest_finite(values).ok_or(NotFinite)?;
        let mut scaling = std::mem::take(&mut self.scaling);
        scaling.equilibrate(&symbolic.pattern, values);
        let found = self.factor(symbolic, &scaling.values, threshold);
        self.is_scaled = true;
        self.scaling = scaling;
        found
    }

    /// Factorises the matrix with these values of the analysed pattern's entries.
    ///
    /// A pivot is at least `threshold` (0 to 1) times the largest entry of its column; where there is
    /// none, the column is delayed to the parent front. Large matrices are divided among several
    /// threads ([`parallel`]); the factors are the same, bit by bit, for any number of them.
    ///
    /// # Errors
    /// [`NotFinite`] where a value is infinite or not a number; the factors are then those of the
    /// matrix before.
    ///
    /// # Panics
    /// Where the number of `values` is not that of the pattern's entries.
    pub fn factor(
        &mut self,
        symbolic: &Symbolic,
        values: &[f64],
        threshold: f64,
    ) -> Result<Inertia, NotFinite> {
        assert_eq!(values.len(), symbolic.pattern.nonzeros());
        let largest = largest_finite(values).ok_or(NotFinite)?;
        self.is_scaled = false;
        let matrix = Matrix {
            values,
            threshold,
            zero_screen: zero_pivots::screen(largest),
        };
        let Some((top, below)) = self.subtrees.split_last_mut() else {
            return Ok(Inertia::default());
        };
        if !below.is_empty() {
            let count = below.len().min(parallel::thread_count());
            // Workers have no memory of their own: a subtree has all that is needed.
            let mut workers = [(); MAX_SUBTREES];
            parallel::for_each(&mut workers[..count], below.iter_mut(), |(), subtree| {
                subtree.factor(&[], symbolic, &matrix);
            });
        }
        top.factor(below, symbolic, &matrix);
        let rows = self.subtrees.iter().map(|subtree| subtree.rows).max();
        let rows = rows.unwrap_or(0);
        if self.vector.len() < rows {
            self.vector.resize(rows, 0.0);
        }
        let found = self.subtrees.iter().map(|subtree| subtree.inertia);
        Ok(found.fold(Inertia::default(), |sum, of| Inertia {
            negative: sum.negative + of.negative,
            zero: sum.zero + of.zero,
            delayed: sum.delayed + of.delayed,
            two_by_two: sum.two_by_two + of.two_by_two,
            entries: sum.entries + of.entries,
        }))
    }
}
