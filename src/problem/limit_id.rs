//! The name of a limit or requirement of a problem.

use super::cost::CostId;
use std::borrow::Cow;
use std::fmt;

/// A limit or requirement of a problem, by the key that it stands under in the problem file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum LimitId {
    /// Joint positions, eq. (8).
    JointPosition,
    /// Joint rates, eq. (9).
    JointVelocity,
    /// Controls u = H⁻¹τ, eq. (11).
    Control,
    /// Joint torques.
    Torque,
    /// Base attitude along the path, eq. (10).
    BaseAttitude,
    /// Rates of the base attitude, eq. (10).
    BaseRate,
    /// Base attitude at t_f.
    FinalBaseAttitude,
    /// Displacement of the base along the path.
    BasePosition,
    /// The terms of the cost about the base, together.
    BaseMotion,
    /// Pairs of bodies that are kept apart.
    KeepOut,
    /// Joint positions at t_f, eq. (13).
    FinalJoints,
    /// The goal of the end effector at t_f.
    EndEffector,
    /// The way-point of that index.
    WayPoint(usize),
    /// What holds a quantity below its largest value, which has a cost.
    Peak(CostId),
}

impl LimitId {
    /// The key in the problem file (`limits.joint_position`, `task.way_points[0]`).
    pub fn key(self) -> Cow<'static, str> {
        match self {
            Self::WayPoint(index) => format!("{}[{index}]", self.list()).into(),
            _ => self.list().into(),
        }
    }

    /// The last part of the key, without an index (`joint_position`, `way_points`).
    pub fn name(self) -> &'static str {
        let key = self.list();
        key.rsplit_once('.').map_or(key, |(_, name)| name)
    }

    /// What a person calls it.
    pub fn words(self) -> &'static str {
        match self {
            Self::JointPosition => "joint position",
            Self::JointVelocity => "joint velocity",
            Self::Control => "control",
            Self::Torque => "torque",
            Self::BaseAttitude => "base attitude",
            Self::BaseRate => "base rate",
            Self::FinalBaseAttitude => "final attitude",
            Self::BasePosition => "base displacement",
            Self::BaseMotion => "base motion",
            Self::KeepOut => "kept apart",
            Self::FinalJoints => "final joint position",
            Self::EndEffector => "end effector",
            Self::WayPoint(_) => "way-point",
            Self::Peak(_) => "peak",
        }
    }

    /// The key without an index.
    fn list(self) -> &'static str {
        match self {
            Self::JointPosition => "limits.joint_position",
            Self::JointVelocity => "limits.joint_velocity",
            Self::Control => "limits.control",
            Self::Torque => "limits.torque",
            Self::BaseAttitude => "limits.base_attitude",
            Self::BaseRate => "limits.base_rate",
            Self::FinalBaseAttitude => "limits.final_base_attitude",
            Self::BasePosition => "limits.base_position",
            Self::BaseMotion => "limits.base_motion",
            Self::KeepOut => "limits.keep_out",
            Self::FinalJoints => "task.final.joints",
            Self::EndEffector => "task.final.end_effector",
            Self::WayPoint(_) => "task.way_points",
            Self::Peak(cost) => cost.key(),
        }
    }

    /// The limit that it belongs to: that along the path, for the same limit at t_f.
    pub fn along_the_path(self) -> Self {
        match self {
            Self::FinalBaseAttitude => Self::BaseAttitude,
            other => other,
        }
    }

    /// Whether its range may lie beside zero: positions may, while rates, accelerations, torques and
    /// the displacement of the base have to be able to vanish.
    pub fn may_exclude_zero(self) -> bool {
        self == Self::JointPosition
    }

    /// Whether it may give way where a problem is infeasible. A peak is as large as it has to be.
    pub fn may_give_way(self) -> bool {
        !matches!(self, Self::Peak(_))
    }

    /// Whether it limits the motion of the base: a requirement of the mission, where limits of the
    /// joints are properties of the hardware.
    pub fn is_on_base(self) -> bool {
        matches!(
            self,
            Self::BaseAttitude
                | Self::BaseRate
                | Self::FinalBaseAttitude
                | Self::BasePosition
                | Self::BaseMotion
        )
    }
}

impl fmt::Display for LimitId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.key())
    }
}

#[cfg(test)]
mod tests {
    use super::LimitId;

    #[test]
    fn keys_are_those_of_the_problem_file() {
        assert_eq!(LimitId::JointPosition.key(), "limits.joint_position");
        assert_eq!(LimitId::FinalJoints.key(), "task.final.joints");
        assert_eq!(LimitId::WayPoint(2).to_string(), "task.way_points[2]");
        assert_eq!(LimitId::WayPoint(2).name(), "way_points");
    }

    #[test]
    fn only_limits_of_the_base_are_on_it() {
        assert!(LimitId::FinalBaseAttitude.is_on_base());
        assert!(!LimitId::KeepOut.is_on_base());
        assert!(!LimitId::EndEffector.is_on_base());
    }
}
