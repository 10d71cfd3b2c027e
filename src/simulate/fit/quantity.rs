//! The figures of a run that an experiment may have measured.

use std::fmt;

/// What is compared of a run and an experiment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeasuredQuantity {
    /// Largest base attitude, rad.
    LargestAttitude,
    /// Base attitude at the end, rad.
    FinalAttitude,
    /// Displacement at the end along x, m.
    FinalX,
    /// Displacement at the end along y, m.
    FinalY,
}

impl MeasuredQuantity {
    /// Whether it is an angle, else a length.
    pub fn is_angle(self) -> bool {
        matches!(self, Self::LargestAttitude | Self::FinalAttitude)
    }

    /// What a person calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::LargestAttitude => "largest attitude",
            Self::FinalAttitude => "final attitude",
            Self::FinalX => "final x",
            Self::FinalY => "final y",
        }
    }
}

impl fmt::Display for MeasuredQuantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
