//! Small dense LDLᵀ of a symmetric positive definite matrix, for any scalar.

use super::unrolled::by_count;
use crate::autodiff::Scalar;

/// Factors L and D of a symmetric positive definite matrix.
#[derive(Debug, Clone)]
pub struct Ldl<S> {
    n: usize,
    /// Unit lower triangle below the diagonal, by rows.
    lower: Vec<S>,
    /// 1/D.
    inverse_diagonal: Vec<S>,
}

impl<S: Scalar> Ldl<S> {
    /// Room for an n×n matrix.
    pub fn new(n: usize) -> Self {
        Self {
            n,
            lower: vec![S::zero(); n * n],
            inverse_diagonal: vec![S::zero(); n],
        }
    }

    /// Factors the lower triangle of `matrix` (n×n, by rows).
    pub fn factor(&mut self, matrix: &[S]) {
        by_count!(S, self.n, n => self.factors(n, matrix));
    }

    #[inline(always)]
    fn factors(&mut self, n: usize, matrix: &[S]) {
        let (matrix, lower) = (&matrix[..n * n], &mut self.lower[..n * n]);
        let inverse_diagonal = &mut self.inverse_diagonal[..n];
        for i in 0..n {
            // Row i of L·D first, turned into L when the diagonal is known.
            for j in 0..i {
                let mut sum = matrix[i * n + j];
                for k in 0..j {
                    sum -= lower[i * n + k] * lower[j * n + k];
                }
                lower[i * n + j] = sum;
            }
            let mut diagonal = matrix[i * n + i];
            for j in 0..i {
                let scaled = lower[i * n + j];
                let l = scaled * inverse_diagonal[j];
                diagonal -= l * scaled;
                lower[i * n + j] = l;
            }
            inverse_diagonal[i] = diagonal.recip();
        }
    }

    /// Overwrites `b` (length n) with the solution.
    pub fn solve(&self, b: &mut [S]) {
        by_count!(S, self.n, n => self.solution(n, b));
    }

    #[inline(always)]
    fn solution(&self, n: usize, b: &mut [S]) {
        let (lower, inverse_diagonal) = (&self.lower[..n * n], &self.inverse_diagonal[..n]);
        let b = &mut b[..n];
        for i in 0..n {
            for k in 0..i {
                let step = lower[i * n + k] * b[k];
                b[i] -= step;
            }
        }
        for i in (0..n).rev() {
            b[i] *= inverse_diagonal[i];
            for k in i + 1..n {
                let step = lower[k * n + i] * b[k];
                b[i] -= step;
            }
        }
    }
}

impl Ldl<f64> {
    /// Hands the factors to `visit`.
    #[inline(always)]
    pub(super) fn visit(&mut self, visit: &mut impl FnMut(&mut [f64])) {
        visit(&mut self.lower);
        visit(&mut self.inverse_diagonal);
    }

    /// Overwrites `b` (length n) with the solution, for constant factors and any scalar in `b`.
    #[inline(always)]
    pub fn solve_constant<S: Scalar>(&self, b: &mut [S]) {
        let n = b.len();
        let (lower, inverse_diagonal) = (&self.lower[..n * n], &self.inverse_diagonal[..n]);
        for i in 0..n {
            for k in 0..i {
                b[i] = b[i].plus_times(b[k], -lower[i * n + k]);
            }
        }
        for i in (0..n).rev() {
            b[i] *= inverse_diagonal[i];
            for k in i + 1..n {
                b[i] = b[i].plus_times(b[k], -lower[k * n + i]);
            }
        }
    }
}
