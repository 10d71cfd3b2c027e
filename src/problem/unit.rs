//! Units of limits and rows.

use crate::dynamics::JointKind;
use std::fmt;

/// The unit of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Unit {
    /// No unit.
    One,
    /// rad.
    Radian,
    /// rad/s.
    RadianPerSecond,
    /// rad/s².
    RadianPerSecondSquared,
    /// m.
    Metre,
    /// m/s.
    MetrePerSecond,
    /// m/s².
    MetrePerSecondSquared,
    /// N·m.
    NewtonMetre,
    /// N.
    Newton,
}

impl Unit {
    /// Of the position of a joint.
    pub fn position(kind: JointKind) -> Self {
        match kind {
            JointKind::Revolute => Self::Radian,
            JointKind::Prismatic => Self::Metre,
        }
    }

    /// Of the rate of a joint.
    pub fn rate(kind: JointKind) -> Self {
        match kind {
            JointKind::Revolute => Self::RadianPerSecond,
            JointKind::Prismatic => Self::MetrePerSecond,
        }
    }

    /// Of the acceleration of a joint.
    pub fn acceleration(kind: JointKind) -> Self {
        match kind {
            JointKind::Revolute => Self::RadianPerSecondSquared,
            JointKind::Prismatic => Self::MetrePerSecondSquared,
        }
    }

    /// Of the torque of a revolute joint, or the force of a prismatic one.
    pub fn effort(kind: JointKind) -> Self {
        match kind {
            JointKind::Revolute => Self::NewtonMetre,
            JointKind::Prismatic => Self::Newton,
        }
    }

    /// Symbol of what resists the acceleration of a joint.
    pub fn inertia(kind: JointKind) -> &'static str {
        match kind {
            JointKind::Revolute => "kg m²",
            JointKind::Prismatic => "kg",
        }
    }

    /// The symbol; "1" where there is no unit.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::One => "1",
            Self::Radian => "rad",
            Self::RadianPerSecond => "rad/s",
            Self::RadianPerSecondSquared => "rad/s²",
            Self::Metre => "m",
            Self::MetrePerSecond => "m/s",
            Self::MetrePerSecondSquared => "m/s²",
            Self::NewtonMetre => "N·m",
            Self::Newton => "N",
        }
    }

    /// Factor and unit by which a person reads a value: angles in degrees. The text follows the
    /// number without a gap.
    pub fn readable(self) -> (f64, &'static str) {
        let degrees = 1f64.to_degrees();
        match self {
            Self::One => (1.0, ""),
            Self::Radian => (degrees, "°"),
            Self::RadianPerSecond => (degrees, "°/s"),
            Self::RadianPerSecondSquared => (degrees, "°/s²"),
            Self::Metre => (1.0, " m"),
            Self::MetrePerSecond => (1.0, " m/s"),
            Self::MetrePerSecondSquared => (1.0, " m/s²"),
            Self::NewtonMetre => (1.0, " N·m"),
            Self::Newton => (1.0, " N"),
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}
