//! Derivatives of the system's mass centre by the joint positions.

use super::algebra::{Algebra, Vector};
use super::{Data, JointKind, Tree};

impl<Sp: Algebra> Tree<Sp> {
    /// Change of the system's mass centre in the base frame by joint position `k`, m a rad or 1.
    /// Needs [`Tree::momentum`].
    ///
    /// The momentum of unit joint rate, the base held, is the total mass times this change.
    pub fn system_center_by(&self, data: &Data<Sp, f64>, k: usize) -> Sp::Linear<f64> {
        data.joints[k].linear.times(1.0 / self.total_mass)
    }

    /// Second derivative of the system's mass centre in the base frame by joint positions `k` and
    /// `l`. Needs [`Tree::momentum`].
    pub fn system_center_by_both(
        &self,
        data: &Data<Sp, f64>,
        k: usize,
        l: usize,
    ) -> Sp::Linear<f64> {
        // The joint nearer to the base turns what the other one does.
        let (inner, outer) = (k.min(l), k.max(l));
        if self.carries(inner, Some(outer)) && self.links[inner].kind == JointKind::Revolute {
            Sp::cross(
                &data.joints[inner].axis,
                &self.system_center_by(data, outer),
            )
        } else {
            Sp::Linear::zero()
        }
    }
}
