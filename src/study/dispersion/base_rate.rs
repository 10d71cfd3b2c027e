//! How the base of several perturbed robots moves where their joints are made to follow a path:
//! conservation of linear and angular momentum, eq. (2) and (5).

use super::chain::Chain;
use super::lanes::{Columns, Lanes, Symmetric, Vector, combined, times, times_shared};
use super::perturbed::Perturbed;
use super::tracking::HarmonicsAt;
use crate::dynamics::JointKind;

/// A joint at one instant of the plan.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointAt {
    pub sin: f64,
    pub cos: f64,
    /// rad or m.
    pub position: f64,
    /// rad/s or m/s.
    pub rate: f64,
}

/// What the base's motion at one instant follows from, in base axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct BaseRate {
    /// Angular velocity without angular momentum.
    pub angular: Vector,
    /// Inverse of the inertia of the whole about its mass centre: angular velocity for a unit of
    /// angular momentum.
    pub per_momentum: Symmetric,
    /// Velocity of the mass centre where the base is held.
    pub drag: Vector,
    /// Mass centre from the base's origin.
    pub center: Vector,
}

impl BaseRate {
    pub const ZERO: Self = Self {
        angular: Vector::ZERO,
        per_momentum: Symmetric::ZERO,
        drag: Vector::ZERO,
        center: Vector::ZERO,
    };
}

/// A body's frame and its motion where the base is held.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    rotation: Columns,
    origin: Vector,
    angular: Vector,
    velocity: Vector,
}

impl Frame {
    /// The base's.
    pub const BASE: Self = Self {
        rotation: [
            Vector([Lanes::ONE, Lanes::ZERO, Lanes::ZERO]),
            Vector([Lanes::ZERO, Lanes::ONE, Lanes::ZERO]),
            Vector([Lanes::ZERO, Lanes::ZERO, Lanes::ONE]),
        ],
        origin: Vector::ZERO,
        angular: Vector::ZERO,
        velocity: Vector::ZERO,
    };
}

/// Sums over all bodies, about the base's origin.
struct Sums {
    moment: Vector,
    inertia: Symmetric,
    linear: Vector,
    angular: Vector,
}

/// The base's motion for `robots` at the instant of `joints` (one a joint) and `harmonics`; `frames`
/// is room for one a joint.
#[inline(always)]
pub(super) fn base_rate(
    chain: &Chain,
    robots: &Perturbed,
    joints: &[JointAt],
    harmonics: &HarmonicsAt,
    frames: &mut [Frame],
) -> BaseRate {
    let base = &robots.bodies[0];
    let mut sums = Sums {
        moment: base.center.scaled(base.mass),
        inertia: base.inertia,
        linear: Vector::ZERO,
        angular: Vector::ZERO,
    };
    sums.inertia.add_point(base.mass, base.center);
    for (j, link) in chain.links.iter().enumerate() {
        let parent = match link.parent {
            Some(p) => frames[p],
            None => Frame::BASE,
        };
        let at = &joints[j];
        let error = &robots.joints[j];
        let mut off = error.offset;
        let mut rate = Lanes::of(at.rate);
        for (k, pair) in error.harmonics.iter().enumerate() {
            for (i, amplitude) in pair.iter().enumerate() {
                off += *amplitude * harmonics.value[k][i];
                rate += *amplitude * harmonics.rate[k][i];
            }
        }
        let fixed = times_shared(&parent.rotation, &link.fixed);
        let mut arm = combined(&parent.rotation, &link.offset);
        let mut frame = Frame {
            rotation: fixed,
            origin: parent.origin,
            angular: parent.angular,
            velocity: parent.velocity,
        };
        match link.kind {
            JointKind::Revolute => {
                let (sin, cos) = off.sin_cos();
                let turned = (sin * at.cos + cos * at.sin, cos * at.cos - sin * at.sin);
                let (sin, cos) = turned;
                frame.rotation[0] = fixed[0].scaled(cos) + fixed[1].scaled(sin);
                frame.rotation[1] = fixed[1].scaled(cos) - fixed[0].scaled(sin);
                frame.angular += fixed[2].scaled(rate);
                frame.velocity += parent.angular.cross(arm);
            }
            JointKind::Prismatic => {
                let along = combined(&fixed, &link.slide);
                arm += along.scaled(off + Lanes::of(at.position));
                frame.velocity += parent.angular.cross(arm) + along.scaled(rate);
            }
        }
        frame.origin += arm;
        frames[j] = frame;

        let body = &robots.bodies[j + 1];
        let own = times(&frame.rotation, &body.center);
        let center = frame.origin + own;
        let momentum = (frame.velocity + frame.angular.cross(own)).scaled(body.mass);
        let inertia = body.inertia.turned(&frame.rotation);
        sums.moment += center.scaled(body.mass);
        sums.linear += momentum;
        sums.angular += inertia.apply(frame.angular) + center.cross(momentum);
        sums.inertia.add(&inertia);
        sums.inertia.add_point(body.mass, center);
    }
    let center = sums.moment.scaled(robots.inverse_mass);
    // About the mass centre of the whole.
    sums.inertia.add_point(-robots.inverse_mass.recip(), center);
    let angular = sums.angular - center.cross(sums.linear);
    let per_momentum = if chain.planar {
        let mut only = Symmetric::ZERO;
        only.0[2] = sums.inertia.0[2].recip();
        only
    } else {
        sums.inertia.inverse()
    };
    BaseRate {
        angular: Vector::ZERO - per_momentum.apply(angular),
        per_momentum,
        drag: sums.linear.scaled(robots.inverse_mass),
        center,
    }
}
