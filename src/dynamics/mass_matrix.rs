//! The reduced inertia matrix H of eq. (6).
//!
//! Derived in docs/algorithms.md#reduced-inertia.

use super::algebra::{Algebra, Vector};
use super::{Data, JointKind, Tree};
use crate::autodiff::Scalar;

impl<Sp: Algebra> Tree<Sp> {
    /// H = H_m − GᵀI₀⁻¹G (lower triangle), with the motion of the mass centre already taken out
    /// of H_m. Needs [`Tree::momentum`].
    pub fn mass_matrix<S: Scalar>(&self, data: &mut Data<Sp, S>) {
        let n = self.links.len();
        let per_mass = -1.0 / self.total_mass;
        for j in 0..n {
            let mut ancestor = Some(j);
            for i in (0..=j).rev() {
                let mut h = data.linear[i].dot(&data.linear[j]) * per_mass
                    - data.about_center[i].dot(&data.base_per_rate[j]);
                if ancestor == Some(i) {
                    // Work of joint i against the momentum that joint j gives its bodies.
                    h += match self.links[i].kind {
                        JointKind::Revolute => data.axis[i]
                            .dot(&(data.angular[j] - Sp::moment(&data.origin[i], &data.linear[j]))),
                        JointKind::Prismatic => data.slide[i].dot(&data.linear[j]),
                    };
                    ancestor = self.links[i].parent;
                }
                data.mass_matrix[j * n + i] = h;
            }
        }
    }
}
