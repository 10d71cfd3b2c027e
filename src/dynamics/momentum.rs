//! Composite rigid bodies and momentum: how joint rates turn the base, eq. (2) and (5).
//!
//! Derived in docs/algorithms.md#momentum-and-base-rate.

use super::algebra::{Algebra, Vector};
use super::{Data, JointKind, Tree};
use crate::autodiff::Scalar;

impl<Sp: Algebra> Tree<Sp> {
    /// Mass centre, inverse composite inertia, and the momentum of the unit rate of every joint.
    ///
    /// Needs [`Tree::kinematics`]. With the base held, unit rate of joint j gives the bodies it
    /// carries the linear momentum P_j and, about the system's mass centre, the angular momentum
    /// G_j.
    pub fn momentum<S: Scalar>(&self, data: &mut Data<Sp, S>) {
        self.composite_bodies(data);
        for (j, link) in self.links.iter().enumerate() {
            let (linear, angular) = match link.kind {
                JointKind::Revolute => {
                    let (axis, origin) = (&data.axis[j], &data.origin[j]);
                    let arm = data.first_moment[j] - origin.times(link.carried);
                    let about_origin = Sp::apply(&data.composite[j], axis)
                        - Sp::moment(&data.first_moment[j], &Sp::cross(axis, origin));
                    (Sp::cross(axis, &arm), about_origin)
                }
                JointKind::Prismatic => (
                    data.slide[j].times(link.carried),
                    Sp::moment(&data.first_moment[j], &data.slide[j]),
                ),
            };
            data.linear[j] = linear;
            data.angular[j] = angular;
            data.about_center[j] = angular - Sp::moment(&data.system_center, &linear);
            data.base_per_rate[j] = Sp::apply(&data.inverse_inertia, &data.about_center[j]);
        }
    }

    /// First moments and inertias of each joint's carried bodies about the base origin; mass
    /// centre and inverse inertia of the whole.
    fn composite_bodies<S: Scalar>(&self, data: &mut Data<Sp, S>) {
        for (j, link) in self.links.iter().enumerate() {
            data.first_moment[j] = data.center[j].times(link.mass);
            data.composite[j] = Sp::with_point_mass(&data.inertia[j], link.mass, &data.center[j]);
        }
        let center = Sp::rotated(&Sp::aligned(), &self.base_center);
        let mut moment: Sp::Linear<S> = center.times(self.base_mass);
        let own = Sp::inertia(&Sp::aligned(), &self.base_inertia);
        let mut inertia = Sp::with_point_mass(&own, self.base_mass, &center);
        for (j, link) in self.links.iter().enumerate().rev() {
            let (carried_moment, carried_inertia) = (data.first_moment[j], data.composite[j]);
            match link.parent {
                Some(parent) => {
                    data.first_moment[parent] += carried_moment;
                    data.composite[parent] = Sp::sum(&data.composite[parent], &carried_inertia);
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
        for (per_rate, &rate) in data.base_per_rate.iter().zip(dq) {
            omega -= per_rate.scaled(rate);
        }
        data.base_rate = omega;
    }
}
