//! Quantities in degrees and centimetres, short.

use crate::ocp::Interval;
use crate::problem::Unit;

/// A value with its unit.
pub(super) fn show(unit: Unit, value: f64) -> String {
    let (factor, unit) = match unit {
        Unit::Metre => (100.0, " cm"),
        Unit::MetrePerSecond => (100.0, " cm/s"),
        Unit::Radian | Unit::RadianPerSecond => unit.readable(),
        // As in the file.
        unit => return format!("{} {unit}", rounded(value)),
    };
    format!("{}{unit}", rounded(factor * value))
}

/// An interval with its unit.
pub(super) fn show_interval(unit: Unit, interval: &Interval) -> String {
    let Interval { lower, upper } = *interval;
    match (lower.is_finite(), upper.is_finite()) {
        (false, false) => "none".into(),
        (true, true) if lower == -upper => format!("±{}", show(unit, upper)),
        (true, true) => format!("{} to {}", show(unit, lower), show(unit, upper)),
        (true, false) => format!("from {}", show(unit, lower)),
        (false, true) => format!("up to {}", show(unit, upper)),
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
