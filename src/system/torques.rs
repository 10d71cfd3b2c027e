//! Joint torques from controls.

use crate::autodiff::Scalar;

/// τ = Hu from the lower triangle of H.
pub(crate) fn torques<S: Scalar>(mass_matrix: &[S], u: &[S], torque: &mut [S]) {
    let n = u.len();
    for i in 0..n {
        let mut sum = S::zero();
        for (j, &uj) in u.iter().enumerate() {
            sum += mass_matrix[i.max(j) * n + i.min(j)] * uj;
        }
        torque[i] = sum;
    }
}
