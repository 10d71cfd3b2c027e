//! Composite rigid bodies and momentum: how joint rates turn the base, eq. (2) and (5).
//!
//! Derived in docs/algorithms.md#momentum-and-base-rate.

use super::algebra::{Algebra, Vector};
use super::unrolled::by_count;
use super::{Data, JointKind, Tree};
use crate::autodiff::Scalar;

impl<Sp: Algebra> Tree<Sp> {
    /// Mass centre, inverse composite inertia, and the momentum of the unit rate of every joint.
    ///
    /// Needs [`Tree::kinematics`]. With the base held, unit rate of joint j gives the bodies it
    /// carries the linear momentum P_j and, about the system's mass centre, the angular momentum
    /// G_j.
    pub fn momentum<S: Scalar>(&self, data: &mut Data<Sp, S>) {
        by_count!(S, self.joint_count(), n => self.momenta(n, data));
    }

    #[inline(always)]
    fn momenta<S: Scalar>(&self, n: usize, data: &mut Data<Sp, S>) {
        self.composite_bodies(n, data);
        let (center, inverse_inertia) = (data.system_center, data.inverse_inertia);
        for (link, joint) in self.links[..n].iter().zip(&mut data.joints[..n]) {
            let (linear, angular) = match link.kind {
                JointKind::Revolute => {
                    let (axis, origin) = (&joint.axis, &joint.origin);
                    let arm = joint.first_moment - origin.times(link.carried);
                    let about_origin = Sp::apply(&joint.composite, axis)
                        - Sp::moment(&joint.first_moment, &Sp::cross(axis, origin));
                    (Sp::cross(axis, &arm), about_origin)
                }
                JointKind::Prismatic => (
                    joint.slide.times(link.carried),
                    Sp::moment(&joint.first_moment, &joint.slide),
                ),
            };
            joint.linear = linear;
            joint.angular = angular;
            joint.about_center = angular - Sp::moment(&center, &linear);
            joint.base_per_rate = Sp::apply(&inverse_inertia, &joint.about_center);
        }
    }

    /// First moments and inertias of each joint's carried bodies about the base origin; mass
    /// centre and inverse inertia of the whole.
    #[inline(always)]
    fn composite_bodies<S: Scalar>(&self, n: usize, data: &mut Data<Sp, S>) {
        let (links, joints) = (&self.links[..n], &mut data.joints[..n]);
        for (link, joint) in links.iter().zip(joints.iter_mut()) {
            joint.first_moment = joint.center.times(link.mass);
            joint.composite = Sp::with_point_mass(&joint.inertia, link.mass, &joint.center);
        }
        let center = Sp::rotated(&Sp::aligned(), &self.base_center);
        let mut moment: Sp::Linear<S> = center.times(self.base_mass);
        let own = Sp::inertia(&Sp::aligned(), &self.base_inertia);
        let mut inertia = Sp::with_point_mass(&own, self.base_mass, &center);
        for j in (0..n).rev() {
            let (carried_moment, carried_inertia) = (joints[j].first_moment, joints[j].composite);
            match links[j].parent {
                Some(parent) => {
                    let carrier = &mut joints[parent];
                    carrier.first_moment += carried_moment;
                    carrier.composite = Sp::sum(&carrier.composite, &carried_inertia);
                }
                None => {
                    moment += carried_moment;
                    inertia = Sp::sum(&inertia, &carried_inertia);
                }
            }
        }
        data.system_center = moment.times(1.0 / self.total_mass);
        let about_center = Sp::with_point_mass(&inertia, -self.total_mass, &data.system_center);
        data.inverse_inertia = Sp::inverse(&about_center);
    }

    /// ω₀ = −I₀⁻¹Gθ̇, the base's angular velocity (base axes, rad/s) for the joint rates `dq`
    /// (length n) at zero total momentum. Needs [`Tree::momentum`].
    pub fn base_rate<S: Scalar>(&self, dq: &[S], data: &mut Data<Sp, S>) {
        let mut omega = Sp::Angular::zero();
        for (joint, &rate) in data.joints.iter().zip(dq) {
            omega -= joint.base_per_rate.scaled(rate);
        }
        data.base_rate = omega;
    }
}
