//! Quantities in degrees and centimetres, short.

use crate::dynamics::JointKind;
use crate::ocp::Interval;

/// What a number is, and so the unit a person reads it in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    /// A position, rad or m.
    Position(JointKind),
    /// A rate, rad/s or m/s.
    Rate(JointKind),
    /// An acceleration, rad/s² or m/s²: as in the file.
    Acceleration(JointKind),
    /// A torque or force: as in the file.
    Effort(JointKind),
}

impl Quantity {
    /// A value with its unit.
    pub(super) fn show(self, value: f64) -> String {
        use JointKind::{Prismatic, Revolute};
        let (factor, unit) = match self {
            Self::Position(Revolute) => (1f64.to_degrees(), "°"),
            Self::Position(Prismatic) => (100.0, " cm"),
            Self::Rate(Revolute) => (1f64.to_degrees(), "°/s"),
            Self::Rate(Prismatic) => (100.0, " cm/s"),
            Self::Acceleration(Revolute) => (1.0, " rad/s²"),
            Self::Acceleration(Prismatic) => (1.0, " m/s²"),
            Self::Effort(Revolute) => (1.0, " N·m"),
            Self::Effort(Prismatic) => (1.0, " N"),
        };
        format!("{}{unit}", rounded(factor * value))
    }

    /// An interval with its unit.
    pub(super) fn show_interval(self, interval: &Interval) -> String {
        let Interval { lower, upper } = *interval;
        match (lower.is_finite(), upper.is_finite()) {
            (false, false) => "none".into(),
            (true, true) if lower == -upper => format!("±{}", self.show(upper)),
            (true, true) => format!("{} to {}", self.show(lower), self.show(upper)),
            (true, false) => format!("from {}", self.show(lower)),
            (false, true) => format!("up to {}", self.show(upper)),
        }
    }
}

/// Six significant digits at most, no trailing zeros.
pub(super) fn rounded(value: f64) -> String {
    let text = format!("{value:.5e}");
    text.parse::<f64>()
        .map_or(text, |value| (value + 0.0).to_string())
}

/// One value where all are alike, else one each by name.
pub(super) fn by_name(names: &[String], values: &[String]) -> String {
    match values {
        [first, rest @ ..] if rest.iter().all(|value| value == first) => first.clone(),
        _ => {
            let pair = |(name, value): (&String, &String)| format!("{name} {value}");
            names
                .iter()
                .zip(values)
                .map(pair)
                .collect::<Vec<_>>()
                .join(", ")
        }
    }
}
