//! The reduced Coriolis force Cθ̇ of eq. (6) by one recursive Newton-Euler pass.
//!
//! Derived in docs/algorithms.md#coriolis-force.

use super::algebra::{Algebra, Vector};
use super::unrolled::by_count;
use super::{Data, JointKind, Tree};
use crate::autodiff::Scalar;

impl<Sp: Algebra> Tree<Sp> {
    /// Cθ̇ for the joint rates `dq` (length n). Needs [`Tree::base_rate`] at the same rates.
    ///
    /// Joint and base accelerations are held at zero; the net force and moment this would take
    /// are then given back through the free base: Cθ̇ = c_m − H_mb H_bb⁻¹ c_b, in which H_bb is
    /// block diagonal about the system's mass centre.
    pub fn bias<S: Scalar>(&self, dq: &[S], data: &mut Data<Sp, S>) {
        by_count!(S, self.joint_count(), n => self.coriolis(n, dq, data));
    }

    #[inline(always)]
    fn coriolis<S: Scalar>(&self, n: usize, dq: &[S], data: &mut Data<Sp, S>) {
        self.accelerations(n, dq, data);
        let (force, torque) = self.net_wrench(n, data);
        (data.net_force, data.net_torque) = (force, torque);
        let per_mass = force.times(1.0 / self.total_mass);
        let (links, joints) = (&self.links[..n], &data.joints[..n]);
        for ((link, joint), bias) in links.iter().zip(joints).zip(&mut data.bias[..n]) {
            let held = match link.kind {
                JointKind::Revolute => joint
                    .axis
                    .dot(&(joint.torque - Sp::moment(&joint.origin, &joint.force))),
                JointKind::Prismatic => joint.slide.dot(&joint.force),
            };
            *bias = held - joint.linear.dot(&per_mass) - joint.base_per_rate.dot(&torque);
        }
    }

    /// Velocity-product accelerations and the wrench each body needs for them, about the base
    /// origin.
    #[inline(always)]
    fn accelerations<S: Scalar>(&self, n: usize, dq: &[S], data: &mut Data<Sp, S>) {
        let (links, joints, dq) = (&self.links[..n], &mut data.joints[..n], &dq[..n]);
        for j in 0..n {
            let link = &links[j];
            let (mut omega, mut alpha, start, acceleration) = match link.parent {
                Some(p) => {
                    let carrier = &joints[p];
                    (
                        carrier.omega,
                        carrier.alpha,
                        carrier.origin,
                        carrier.acceleration,
                    )
                }
                None => (
                    data.base_rate,
                    Sp::Angular::zero(),
                    Sp::Linear::zero(),
                    Sp::Linear::zero(),
                ),
            };
            let joint = &mut joints[j];
            let mut at_joint =
                acceleration + carried::<Sp, S>(&omega, &alpha, &(joint.origin - start));
            match link.kind {
                JointKind::Revolute => {
                    let spin = joint.axis.scaled(dq[j]);
                    if Sp::ANGLES > 1 {
                        alpha += Sp::cross_angular(&omega, &spin);
                    }
                    omega += spin;
                }
                JointKind::Prismatic => {
                    at_joint += Sp::cross(&omega, &joint.slide.scaled(dq[j])).times(2.0);
                }
            }
            let center = joint.center;
            let at_center = at_joint + carried::<Sp, S>(&omega, &alpha, &(center - joint.origin));
            let force = at_center.times(link.mass);
            let mut torque = Sp::moment(&center, &force);
            if Sp::ANGLES > 1 {
                let inertia = &joint.inertia;
                torque += Sp::apply(inertia, &alpha)
                    + Sp::cross_angular(&omega, &Sp::apply(inertia, &omega));
            }
            joint.omega = omega;
            joint.alpha = alpha;
            joint.acceleration = at_joint;
            joint.force = force;
            joint.torque = torque;
        }
    }

    /// Sums wrenches inwards; returns the total, its moment about the system's mass centre.
    #[inline(always)]
    fn net_wrench<S: Scalar>(
        &self,
        n: usize,
        data: &mut Data<Sp, S>,
    ) -> (Sp::Linear<S>, Sp::Angular<S>) {
        let omega = data.base_rate;
        let center = Sp::rotated(&Sp::aligned(), &self.base_center);
        let mut force =
            carried::<Sp, S>(&omega, &Sp::Angular::zero(), &center).times(self.base_mass);
        let mut torque = Sp::moment(&center, &force);
        if Sp::ANGLES > 1 {
            let own = Sp::inertia(&Sp::aligned(), &self.base_inertia);
            torque += Sp::cross_angular(&omega, &Sp::apply(&own, &omega));
        }
        let (links, joints) = (&self.links[..n], &mut data.joints[..n]);
        for j in (0..n).rev() {
            let (f, t) = (joints[j].force, joints[j].torque);
            match links[j].parent {
                Some(parent) => {
                    joints[parent].force += f;
                    joints[parent].torque += t;
                }
                None => {
                    force += f;
                    torque += t;
                }
            }
        }
        (force, torque - Sp::moment(&data.system_center, &force))
    }
}

/// Acceleration that a rotating frame gives a point at `r` from its origin: α×r + ω×(ω×r).
#[inline(always)]
fn carried<Sp: Algebra, S: Scalar>(
    omega: &Sp::Angular<S>,
    alpha: &Sp::Angular<S>,
    r: &Sp::Linear<S>,
) -> Sp::Linear<S> {
    let centripetal = Sp::cross(omega, &Sp::cross(omega, r));
    if Sp::ANGLES > 1 {
        centripetal + Sp::cross(alpha, r)
    } else {
        centripetal
    }
}
