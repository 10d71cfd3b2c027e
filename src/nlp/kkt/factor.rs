//! Numerical factorisation, part by part of the tree.

use super::division::PARTS;
use super::noise;
use super::part::{Inertia, Matrix, Part};
use super::symbolic::Symbolic;
use super::update::largest_finite;
use crate::parallel;

/// The matrix has a value that is infinite or not a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the matrix has a value that is not finite")]
pub struct NotFinite;

/// The factors of a matrix, and the memory to make them.
#[derive(Debug, Clone, Default)]
pub struct Factors {
    pub(super) parts: Vec<Part>,
    pub(super) vector: Vec<f64>,
}

impl Factors {
    /// Memory for matrices of this pattern; delayed pivots may make it grow.
    pub fn new(symbolic: &Symbolic) -> Self {
        let sizes = symbolic.parts.iter();
        Self {
            parts: sizes.map(|size| Part::new(size, symbolic.len())).collect(),
            vector: Vec::new(),
        }
    }

    /// Factorises the matrix with these values of the analysed pattern's entries.
    ///
    /// A pivot is at least `threshold` times the largest entry of its column, or is delayed.
    /// Large matrices are divided among the threads ([`parallel`]); the factors are the same, bit by
    /// bit, for any number of them.
    ///
    /// # Errors
    /// [`NotFinite`], the factors then being of no use.
    ///
    /// # Panics
    /// Where `values` are not as many as the pattern's entries.
    pub fn factor(
        &mut self,
        symbolic: &Symbolic,
        values: &[f64],
        threshold: f64,
    ) -> Result<Inertia, NotFinite> {
        assert_eq!(values.len(), symbolic.pattern.nonzeros());
        let largest = largest_finite(values).ok_or(NotFinite)?;
        let matrix = Matrix {
            values,
            threshold,
            suspected: noise::suspected(largest),
        };
        let Some((top, below)) = self.parts.split_last_mut() else {
            return Ok(Inertia::default());
        };
        if !below.is_empty() {
            let count = below.len().min(parallel::thread_count());
            // Workers have nothing of their own: a part has all that is needed.
            let mut workers = [(); PARTS];
            parallel::for_each(&mut workers[..count], below.iter_mut(), |(), part| {
                part.factor(&[], symbolic, &matrix);
            });
        }
        top.factor(below, symbolic, &matrix);
        let rows = self.parts.iter().map(|part| part.rows).max().unwrap_or(0);
        if self.vector.len() < rows {
            self.vector.resize(rows, 0.0);
        }
        let found = self.parts.iter().map(|part| part.inertia);
        Ok(found.fold(Inertia::default(), |sum, part| Inertia {
            negative: sum.negative + part.negative,
            zero: sum.zero + part.zero,
            delayed: sum.delayed + part.delayed,
            pairs: sum.pairs + part.pairs,
        }))
    }
}
