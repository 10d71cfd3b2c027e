//! Poses of all bodies in the base frame, eq. (1).

use super::algebra::{Algebra, Vector};
use super::{Data, JointKind, Tree};
use crate::autodiff::Scalar;

impl<Sp: Algebra> Tree<Sp> {
    /// Orientation, joint origin, axis and mass centre of every body for the joint positions `q`
    /// (rad or m, length n).
    pub fn kinematics<S: Scalar>(&self, q: &[S], data: &mut Data<Sp, S>) {
        for (j, link) in self.links.iter().enumerate() {
            let (carrier, origin) = match link.parent {
                Some(parent) => (data.orientation[parent], data.origin[parent]),
                None => (Sp::aligned(), Sp::Linear::zero()),
            };
            let mut joint = origin + Sp::rotated(&carrier, &link.offset);
            let angle = (link.kind == JointKind::Revolute).then(|| q[j].sin_cos());
            let orientation = Sp::after_joint(&carrier, &link.fixed, angle, link.sign);
            match link.kind {
                JointKind::Revolute => data.axis[j] = Sp::axis(&orientation, link.sign),
                JointKind::Prismatic => {
                    data.slide[j] = Sp::rotated(&orientation, &link.slide);
                    joint += data.slide[j].scaled(q[j]);
                }
            }
            data.orientation[j] = orientation;
            data.origin[j] = joint;
            // Mass that the joint turns into itself is seen at position zero: then nothing that
            // follows depends on this position, neither by its value nor by its operations.
            let seen = if link.symmetric {
                Sp::after_joint(&carrier, &link.fixed, None, link.sign)
            } else {
                orientation
            };
            data.center[j] = joint + Sp::rotated(&seen, &link.center);
            data.inertia[j] = Sp::inertia(&seen, &link.inertia);
        }
    }
}
