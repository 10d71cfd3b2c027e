//! Limits of the motion.

use super::components::{ComponentKind, base_sizes};
use super::keep_out::KeepOut;
use super::limit_id::LimitId;
use super::unit::Unit;
use crate::dynamics::{JointKind, Model};
use crate::ocp::Interval;

/// Limits (8) to (11). Free intervals where there is none.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Limits {
    /// Joint positions, rad or m; length n, eq. (8).
    pub joint_position: Vec<Interval>,
    /// Joint rates, rad/s or m/s; length n, eq. (9).
    pub joint_velocity: Vec<Interval>,
    /// Controls u = H⁻¹τ, rad/s² or m/s²; length n, eq. (11).
    pub control: Vec<Interval>,
    /// Joint torques, N·m or N; length n.
    pub torque: Vec<Interval>,
    /// Base attitude along the path, rad, eq. (10): one an angle; by quaternion or modified
    /// Rodrigues parameters one for the rotation angle out of the axes that it is counted from, symmetric.
    pub base_attitude: Vec<Interval>,
    /// Rates of the base attitude angles, rad/s, one an angle, eq. (10); by quaternion or modified
    /// Rodrigues parameters the angular velocity along each base axis.
    pub base_rate: Vec<Interval>,
    /// Base attitude at t_f, rad, as along the path.
    pub final_base_attitude: Vec<Interval>,
    /// Displacement of the base from where it was at t₀, along the whole path, inertial axes, m; one
    /// a length.
    pub base_position: Vec<Interval>,
    /// The terms of the cost (14) about the base, together, with their weights: ε of the ε-constraint
    /// method; infinite where there is none.
    pub base_motion: f64,
    /// Pairs kept apart along the path.
    pub keep_out: Vec<KeepOut>,
}

/// One limit, with `B` its bounds: `&Vec<Interval>` or `&mut Vec<Interval>`.
#[derive(Debug)]
#[non_exhaustive]
pub struct LimitEntry<B> {
    /// Which limit.
    pub id: LimitId,
    /// What there is one bound of.
    pub components: ComponentKind,
    /// The bounds.
    pub bounds: B,
    /// Its unit for a joint of that kind; of the base, angles are as of revolute joints and lengths
    /// as of prismatic ones.
    unit: fn(JointKind) -> Unit,
}

impl<B> LimitEntry<B> {
    /// The unit of component `i` on `robot`.
    pub fn unit(&self, robot: &Model, i: usize) -> Unit {
        (self.unit)(match self.components {
            ComponentKind::Joint => robot.joints()[i].kind,
            ComponentKind::BaseAttitude | ComponentKind::BaseRate => JointKind::Revolute,
            // No limit is on the base as a whole.
            ComponentKind::BasePosition | ComponentKind::Base => JointKind::Prismatic,
        })
    }
}

/// The table of all limits that have bounds by component. A new one is a line here and a field.
#[rustfmt::skip]
macro_rules! table {
    ($limits:ident, $($borrow:tt)+) => {{
        use ComponentKind::{BaseAttitude, BasePosition, BaseRate, Joint};
        use LimitId as Id;
        [
            LimitEntry { id: Id::JointPosition, components: Joint, bounds: $($borrow)+ $limits.joint_position, unit: Unit::position },
            LimitEntry { id: Id::JointVelocity, components: Joint, bounds: $($borrow)+ $limits.joint_velocity, unit: Unit::rate },
            LimitEntry { id: Id::Control, components: Joint, bounds: $($borrow)+ $limits.control, unit: Unit::acceleration },
            LimitEntry { id: Id::Torque, components: Joint, bounds: $($borrow)+ $limits.torque, unit: Unit::effort },
            LimitEntry { id: Id::BaseAttitude, components: BaseAttitude, bounds: $($borrow)+ $limits.base_attitude, unit: Unit::position },
            LimitEntry { id: Id::BaseRate, components: BaseRate, bounds: $($borrow)+ $limits.base_rate, unit: Unit::rate },
            LimitEntry { id: Id::FinalBaseAttitude, components: BaseAttitude, bounds: $($borrow)+ $limits.final_base_attitude, unit: Unit::position },
            LimitEntry { id: Id::BasePosition, components: BasePosition, bounds: $($borrow)+ $limits.base_position, unit: Unit::position },
        ]
    }};
}

impl Limits {
    /// The limits of the joints of `robot`, and none on its base.
    pub fn of(robot: &Model) -> Self {
        let joints = robot.joints();
        let (angles, lengths) = base_sizes(robot);
        let free = |count: usize| vec![Interval::FREE; count];
        Self {
            joint_position: joints
                .iter()
                .map(|j| Interval::new(j.limits.position[0], j.limits.position[1]))
                .collect(),
            joint_velocity: joints
                .iter()
                .map(|j| Interval::symmetric(j.limits.velocity))
                .collect(),
            control: free(joints.len()),
            torque: joints
                .iter()
                .map(|j| Interval::symmetric(j.limits.effort))
                .collect(),
            base_attitude: free(angles),
            base_rate: free(angles),
            final_base_attitude: free(angles),
            base_position: free(lengths),
            base_motion: f64::INFINITY,
            keep_out: Vec::new(),
        }
    }

    /// Every limit that has bounds by component, in the order of the problem file.
    pub fn entries(&self) -> impl Iterator<Item = LimitEntry<&Vec<Interval>>> {
        table!(self, &).into_iter()
    }

    /// The same, to be changed.
    pub fn entries_mut(&mut self) -> impl Iterator<Item = LimitEntry<&mut Vec<Interval>>> {
        table!(self, &mut).into_iter()
    }
}
