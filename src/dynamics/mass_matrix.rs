//! The reduced inertia matrix H of eq. (6).
//!
//! Derived in docs/algorithms.md#reduced-inertia.

use super::algebra::{Algebra, Vector};
use super::unrolled::by_count;
use super::{Data, JointKind, Tree};
use crate::autodiff::Scalar;

impl<Sp: Algebra> Tree<Sp> {
    /// H = H_m − GᵀI₀⁻¹G (lower triangle), with the motion of the mass centre already taken out
    /// of H_m. Needs [`Tree::momentum`].
    pub fn mass_matrix<S: Scalar>(&self, data: &mut Data<Sp, S>) {
        by_count!(S, self.joint_count(), n => self.reduced_inertia(n, data));
    }

    #[inline(always)]
    fn reduced_inertia<S: Scalar>(&self, n: usize, data: &mut Data<Sp, S>) {
        let (links, joints) = (&self.links[..n], &data.joints[..n]);
        let matrix = &mut data.mass_matrix[..n * n];
        let per_mass = -1.0 / self.total_mass;
        for j in 0..n {
            let outer = &joints[j];
            let mut ancestor = Some(j);
            for i in (0..=j).rev() {
                let inner = &joints[i];
                let mut h = inner.linear.dot(&outer.linear) * per_mass
                    - inner.about_center.dot(&outer.base_per_rate);
                if ancestor == Some(i) {
                    // Work of joint i against the momentum that joint j gives its bodies.
                    h += match links[i].kind {
                        JointKind::Revolute => inner
                            .axis
                            .dot(&(outer.angular - Sp::moment(&inner.origin, &outer.linear))),
                        JointKind::Prismatic => inner.slide.dot(&outer.linear),
                    };
                    ancestor = links[i].parent;
                }
                matrix[j * n + i] = h;
            }
        }
    }
}
