//! Positions of frames fixed in bodies as seen from other bodies, with their derivatives.

use super::algebra::{Algebra, Planar, Vector};
use super::{Data, JointKind, Mount, Tree};
use crate::autodiff::Scalar;

impl<Sp: Algebra> Tree<Sp> {
    /// Position of a mounted frame's origin relative to that of `other`, in the axes of the body
    /// that carries `other`, m. Needs [`Tree::kinematics`].
    pub fn relative_position<S: Scalar>(
        &self,
        mount: &Mount<Sp>,
        other: &Mount<Sp>,
        data: &Data<Sp, S>,
    ) -> Sp::Linear<S> {
        let apart = self.position(mount, data) - self.position(other, data);
        self.along_body_axes(other, data, apart)
    }

    /// Change of [`Tree::relative_position`] by joint position `k`, m a rad or m.
    pub fn relative_position_by(
        &self,
        mount: &Mount<Sp>,
        other: &Mount<Sp>,
        data: &Data<Sp, f64>,
        k: usize,
    ) -> Sp::Linear<f64> {
        let change = self.relative_change(mount, other, data, k);
        self.along_body_axes(other, data, change)
    }

    /// Second derivative of [`Tree::relative_position`] by joint positions `k` and `l`.
    pub fn relative_position_by_both(
        &self,
        mount: &Mount<Sp>,
        other: &Mount<Sp>,
        data: &Data<Sp, f64>,
        k: usize,
        l: usize,
    ) -> Sp::Linear<f64> {
        let sense = |k| self.relative_sense(mount, other, k);
        // On the way from `other` to `mount`, first inwards and then outwards: the joint that
        // comes first turns what the other one does.
        let inwards = |k| sense(k) < 0.0;
        let (first, then) = match (inwards(k), inwards(l)) {
            (true, true) => (k.max(l), k.min(l)),
            (false, false) => (k.min(l), k.max(l)),
            (true, false) => (k, l),
            (false, true) => (l, k),
        };
        if sense(first) == 0.0 || self.links[first].kind == JointKind::Prismatic {
            return Sp::Linear::zero();
        }
        let change = self.relative_change(mount, other, data, then);
        let turned = Sp::cross(&data.joints[first].axis, &change).times(sense(first));
        self.along_body_axes(other, data, turned)
    }

    /// Joints that move `mount` as seen from the body that carries `other`, ascending.
    pub fn joints_between(&self, mount: &Mount<Sp>, other: &Mount<Sp>) -> Vec<usize> {
        let moves = |k: &usize| self.relative_sense(mount, other, *k) != 0.0;
        (0..self.joint_count()).filter(moves).collect()
    }

    /// Height of a mounted frame's origin above that of `other` along the plane's normal, m; zero
    /// in space, where there is no plane.
    pub fn height_between(&self, mount: &Mount<Sp>, other: &Mount<Sp>) -> f64 {
        if Sp::LENGTHS == Planar::LENGTHS {
            mount.height - other.height
        } else {
            0.0
        }
    }

    /// Change of the mounted frame's origin by joint position `k`, as seen from the body that
    /// carries `other`, in base axes.
    fn relative_change(
        &self,
        mount: &Mount<Sp>,
        other: &Mount<Sp>,
        data: &Data<Sp, f64>,
        k: usize,
    ) -> Sp::Linear<f64> {
        let sense = self.relative_sense(mount, other, k);
        if sense == 0.0 {
            return Sp::Linear::zero();
        }
        let change = match self.links[k].kind {
            JointKind::Revolute => {
                let arm = self.position(mount, data) - data.joints[k].origin;
                Sp::cross(&data.joints[k].axis, &arm)
            }
            JointKind::Prismatic => data.joints[k].slide,
        };
        change.times(sense)
    }

    /// 1 where joint `k` moves `mount` alone, −1 where it moves `other` alone, else 0.
    fn relative_sense(&self, mount: &Mount<Sp>, other: &Mount<Sp>, k: usize) -> f64 {
        match (self.carries(k, mount.link), self.carries(k, other.link)) {
            (true, false) => 1.0,
            (false, true) => -1.0,
            _ => 0.0,
        }
    }

    /// A vector in base axes by its components along the axes of the body that carries `mount`.
    fn along_body_axes<S: Scalar>(
        &self,
        mount: &Mount<Sp>,
        data: &Data<Sp, S>,
        vector: Sp::Linear<S>,
    ) -> Sp::Linear<S> {
        match mount.link {
            Some(j) => Sp::along_axes(&data.joints[j].orientation, &vector),
            None => vector,
        }
    }
}
