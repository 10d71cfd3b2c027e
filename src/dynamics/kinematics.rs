//! Poses of all bodies in the base frame, eq. (1).

use super::algebra::{Algebra, Vector};
use super::unrolled::by_count;
use super::{Data, JointKind, Tree};
use crate::autodiff::Scalar;

impl<Sp: Algebra> Tree<Sp> {
    /// Orientation, joint origin, axis and mass centre of every body for the joint positions `q`
    /// (rad or m, length n).
    pub fn kinematics<S: Scalar>(&self, q: &[S], data: &mut Data<Sp, S>) {
        by_count!(S, self.joint_count(), n => self.poses(n, q, data));
    }

    #[inline(always)]
    fn poses<S: Scalar>(&self, n: usize, q: &[S], data: &mut Data<Sp, S>) {
        let (links, joints, q) = (&self.links[..n], &mut data.joints[..n], &q[..n]);
        for j in 0..n {
            let link = &links[j];
            let (carrier, origin) = match link.parent {
                Some(parent) => (joints[parent].orientation, joints[parent].origin),
                None => (Sp::aligned(), Sp::Linear::zero()),
            };
            let joint = &mut joints[j];
            let mut at_joint = origin + Sp::rotated(&carrier, &link.offset);
            let angle = (link.kind == JointKind::Revolute).then(|| q[j].sin_cos());
            let orientation = Sp::after_joint(&carrier, &link.fixed, angle, link.sign);
            match link.kind {
                JointKind::Revolute => joint.axis = Sp::axis(&orientation, link.sign),
                JointKind::Prismatic => {
                    joint.slide = Sp::rotated(&orientation, &link.slide);
                    at_joint += joint.slide.scaled(q[j]);
                }
            }
            joint.orientation = orientation;
            joint.origin = at_joint;
            // Mass that the joint turns into itself is seen at position zero: then nothing that
            // follows depends on this position, neither by its value nor by its operations.
            let seen = if link.symmetric {
                Sp::after_joint(&carrier, &link.fixed, None, link.sign)
            } else {
                orientation
            };
            joint.center = at_joint + Sp::rotated(&seen, &link.center);
            joint.inertia = Sp::inertia(&seen, &link.inertia);
        }
    }
}
