//! Small dense LDLᵀ of a symmetric positive definite matrix, for any scalar.

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
        let n = self.n;
        for i in 0..n {
            // Row i of L·D first, turned into L when the diagonal is known.
            for j in 0..i {
                let mut sum = matrix[i * n + j];
                for k in 0..j {
                    sum -= self.lower[i * n + k] * self.lower[j * n + k];
                }
                self.lower[i * n + j] = sum;
            }
            let mut diagonal = matrix[i * n + i];
            for j in 0..i {
                let scaled = self.lower[i * n + j];
                let l = scaled * self.inverse_diagonal[j];
                diagonal -= l * scaled;
                self.lower[i * n + j] = l;
            }
            self.inverse_diagonal[i] = diagonal.recip();
        }
    }

    /// Overwrites `b` (length n) with the solution.
    pub fn solve(&self, b: &mut [S]) {
        let n = self.n;
        for i in 0..n {
            for k in 0..i {
                let step = self.lower[i * n + k] * b[k];
                b[i] -= step;
            }
        }
        for i in (0..n).rev() {
            b[i] *= self.inverse_diagonal[i];
            for k in i + 1..n {
                let step = self.lower[k * n + i] * b[k];
                b[i] -= step;
            }
        }
    }
}

impl Ldl<f64> {
    /// Hands the factors to `visit`.
    pub(super) fn visit(&mut self, visit: &mut impl FnMut(&mut [f64])) {
        visit(&mut self.lower);
        visit(&mut self.inverse_diagonal);
    }

    /// Overwrites `b` (length n) with the solution, for constant factors and any scalar in `b`.
    #[inline(always)]
    pub fn solve_constant<S: Scalar>(&self, b: &mut [S]) {
        let n = self.n;
        for i in 0..n {
            for k in 0..i {
                b[i] = b[i].plus_times(b[k], -self.lower[i * n + k]);
            }
        }
        for i in (0..n).rev() {
            b[i] *= self.inverse_diagonal[i];
            for k in i + 1..n {
                b[i] = b[i].plus_times(b[k], -self.lower[k * n + i]);
            }
        }
    }
}
