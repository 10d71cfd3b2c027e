//! The reduced Coriolis force Cθ̇ of eq. (6) by one recursive Newton-Euler pass.
//!
//! Derived in docs/algorithms.md#coriolis-force.

use super::algebra::{Algebra, Vector};
use super::{Data, JointKind, Tree};
use crate::autodiff::Scalar;

impl<Sp: Algebra> Tree<Sp> {
    /// Cθ̇ for the joint rates `dq` (length n). Needs [`Tree::base_rate`] at the same rates.
    ///
    /// Joint and base accelerations are held at zero; the net force and moment this would take
    /// are then given back through the free base: Cθ̇ = c_m − H_mb H_bb⁻¹ c_b, in which H_bb is
    /// block diagonal about the system's mass centre.
    pub fn bias<S: Scalar>(&self, dq: &[S], data: &mut Data<Sp, S>) {
        self.accelerations(dq, data);
        let (force, torque) = self.net_wrench(data);
        (data.net_force, data.net_torque) = (force, torque);
        let per_mass = force.times(1.0 / self.total_mass);
        for (j, link) in self.links.iter().enumerate() {
            let held = match link.kind {
                JointKind::Revolute => data.axis[j]
                    .dot(&(data.torque[j] - Sp::moment(&data.origin[j], &data.force[j]))),
                JointKind::Prismatic => data.slide[j].dot(&data.force[j]),
            };
            data.bias[j] =
                held - data.linear[j].dot(&per_mass) - data.base_per_rate[j].dot(&torque);
        }
    }

    /// Velocity-product accelerations and the wrench each body needs for them, about the base
    /// origin.
    fn accelerations<S: Scalar>(&self, dq: &[S], data: &mut Data<Sp, S>) {
        for (j, link) in self.links.iter().enumerate() {
            let (mut omega, mut alpha, start, acceleration) = match link.parent {
                Some(p) => (
                    data.omega[p],
                    data.alpha[p],
                    data.origin[p],
                    data.acceleration[p],
                ),
                None => (
                    data.base_rate,
                    Sp::Angular::zero(),
                    Sp::Linear::zero(),
                    Sp::Linear::zero(),
                ),
            };
            let mut at_joint =
                acceleration + carried::<Sp, S>(&omega, &alpha, &(data.origin[j] - start));
            match link.kind {
                JointKind::Revolute => {
                    let spin = data.axis[j].scaled(dq[j]);
                    if Sp::ANGLES > 1 {
                        alpha += Sp::cross_angular(&omega, &spin);
                    }
                    omega += spin;
                }
                JointKind::Prismatic => {
                    at_joint += Sp::cross(&omega, &data.slide[j].scaled(dq[j])).times(2.0);
                }
            }
            let center = data.center[j];
            let at_center = at_joint + carried::<Sp, S>(&omega, &alpha, &(center - data.origin[j]));
            let force = at_center.times(link.mass);
            let mut torque = Sp::moment(&center, &force);
            if Sp::ANGLES > 1 {
                let inertia = &data.inertia[j];
                torque += Sp::apply(inertia, &alpha)
                    + Sp::cross_angular(&omega, &Sp::apply(inertia, &omega));
            }
            data.omega[j] = omega;
            data.alpha[j] = alpha;
            data.acceleration[j] = at_joint;
            data.force[j] = force;
            data.torque[j] = torque;
        }
    }

    /// Sums wrenches inwards; returns the total, its moment about the system's mass centre.
    fn net_wrench<S: Scalar>(&self, data: &mut Data<Sp, S>) -> (Sp::Linear<S>, Sp::Angular<S>) {
        let omega = data.base_rate;
        let center = Sp::rotated(&Sp::aligned(), &self.base_center);
        let mut force =
            carried::<Sp, S>(&omega, &Sp::Angular::zero(), &center).times(self.base_mass);
        let mut torque = Sp::moment(&center, &force);
        if Sp::ANGLES > 1 {
            let own = Sp::inertia(&Sp::aligned(), &self.base_inertia);
            torque += Sp::cross_angular(&omega, &Sp::apply(&own, &omega));
        }
        for (j, link) in self.links.iter().enumerate().rev() {
            let (f, t) = (data.force[j], data.torque[j]);
            match link.parent {
                Some(parent) => {
                    data.force[parent] += f;
                    data.torque[parent] += t;
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
#[inline]
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
