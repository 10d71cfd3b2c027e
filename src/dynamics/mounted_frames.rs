//! Pose of frames fixed in bodies: the end effector, and points that are kept clear of each other.

use super::algebra::{Algebra, Vector};
use super::{Data, JointKind, Mount, Tree};
use crate::autodiff::Scalar;

impl<Sp: Algebra> Tree<Sp> {
    /// Position of a mounted frame's origin in the base frame, m. Needs [`Tree::kinematics`].
    pub fn position<S: Scalar>(&self, mount: &Mount<Sp>, data: &Data<Sp, S>) -> Sp::Linear<S> {
        match mount.link {
            Some(j) => {
                data.joints[j].origin + Sp::rotated(&data.joints[j].orientation, &mount.offset)
            }
            None => Sp::rotated(&Sp::aligned(), &mount.offset),
        }
    }

    /// Change of [`Tree::position`] by joint position `k`, m a rad or m.
    pub fn position_by(
        &self,
        mount: &Mount<Sp>,
        data: &Data<Sp, f64>,
        k: usize,
    ) -> Sp::Linear<f64> {
        if !self.carries(k, mount.link) {
            return Sp::Linear::zero();
        }
        match self.links[k].kind {
            JointKind::Revolute => {
                let arm = self.position(mount, data) - data.joints[k].origin;
                Sp::cross(&data.joints[k].axis, &arm)
            }
            JointKind::Prismatic => data.joints[k].slide,
        }
    }

    /// Second derivative of [`Tree::position`] by joint positions `k` and `l`.
    pub fn position_by_both(
        &self,
        mount: &Mount<Sp>,
        data: &Data<Sp, f64>,
        k: usize,
        l: usize,
    ) -> Sp::Linear<f64> {
        // The joint nearer to the base turns what the other one does.
        let (inner, outer) = (k.min(l), k.max(l));
        let turned =
            self.carries(inner, mount.link) && self.links[inner].kind == JointKind::Revolute;
        if turned {
            Sp::cross(
                &data.joints[inner].axis,
                &self.position_by(mount, data, outer),
            )
        } else {
            Sp::Linear::zero()
        }
    }

    /// Orientation of a mounted frame in the base frame. Needs [`Tree::kinematics`].
    pub fn orientation<S: Scalar>(
        &self,
        mount: &Mount<Sp>,
        data: &Data<Sp, S>,
    ) -> Sp::Orientation<S> {
        match mount.link {
            Some(j) => Sp::attached(&data.joints[j].orientation, &mount.orientation),
            None => Sp::attached(&Sp::aligned(), &mount.orientation),
        }
    }

    /// Orientation and position (m) of the end-effector frame in the base frame; `None` where the
    /// robot has none. Needs [`Tree::kinematics`].
    pub fn end_effector<S: Scalar>(
        &self,
        data: &Data<Sp, S>,
    ) -> Option<(Sp::Orientation<S>, Sp::Linear<S>)> {
        let mount = self.end_effector.as_ref()?;
        Some((self.orientation(mount, data), self.position(mount, data)))
    }
}
