//! Numbers as a person reads them.

use crate::dynamics::attitude::SpatialAttitude;
use crate::numeric::largest_or_nan;
use crate::solution::Timing;
use crate::text::digits::digits;
use std::time::Duration;

/// An angle (rad) in degrees: three decimals, more where it is small.
pub fn degrees(angle: f64) -> String {
    format!("{}°", digits(angle.to_degrees(), 3, 2))
}

/// A length (m) in centimetres: three decimals, more where it is small.
pub fn centimetres(length: f64) -> String {
    format!("{} cm", digits(100.0 * length, 3, 2))
}

/// A difference that should be small: by a power of ten where it is.
pub(super) fn gap(difference: f64) -> String {
    match difference < 0.01 {
        true => format!("{difference:.1e}"),
        false => digits(difference, 2, 2),
    }
}

/// A time in ms or s, three digits.
pub fn seconds(time: Duration) -> String {
    let s = time.as_secs_f64();
    match s {
        s if s < 0.1 => format!("{:.1} ms", 1e3 * s),
        s if s < 1.0 => format!("{:.0} ms", 1e3 * s),
        s if s < 10.0 => format!("{s:.2} s"),
        s => format!("{s:.1} s"),
    }
}

/// [`seconds`] of a number of them, s.
pub(super) fn time(s: f64) -> String {
    seconds(Duration::try_from_secs_f64(s).unwrap_or_default())
}

/// Where the time went.
pub(super) fn shares(timing: Timing) -> String {
    format!(
        "{}: derivatives {}, linear solver {}, rest of Ipopt {}, set-up {}",
        time(timing.total),
        time(timing.derivatives),
        time(timing.linear_solver),
        time(timing.ipopt_other),
        time(timing.setup)
    )
}

/// An orientation as one rotation out of the inertial axes, its axis in them.
pub fn rotation(attitude: SpatialAttitude, eta: &[f64]) -> String {
    let turn = attitude.to_quaternion(eta);
    match turn.axis() {
        Some(axis) => {
            let [x, y, z] = [0, 1, 2].map(|i| unsigned_zero(axis[i], 3));
            format!("{} about ({x:.3}, {y:.3}, {z:.3})", degrees(turn.angle()))
        }
        None => degrees(0.0),
    }
}

/// The cost J.
pub(super) fn cost(objective: f64) -> String {
    digits(objective, 9, 6)
}

/// What the cost J of an infeasible plan is the cost of.
pub(super) const OF_RELAXED: &str = "of the motion below, which does not keep all limits";

/// Keeps "-0.000" from being printed.
fn unsigned_zero(value: f64, decimals: i32) -> f64 {
    if value.abs() < 0.5 * 10f64.powi(-decimals) {
        0.0
    } else {
        value
    }
}

/// Part of the largest of several values below which one is rounding, and shown as zero.
const ROUNDING: f64 = 1e-9;

/// Several values in brackets, or the one alone.
pub(super) fn list(values: &[f64], show: fn(f64) -> String) -> String {
    let least = ROUNDING * largest_or_nan(values.iter().map(|value| value.abs()));
    let shown = |value: f64| show(if value.abs() < least { 0.0 } else { value });
    let shown: Vec<String> = values.iter().map(|value| shown(*value)).collect();
    if shown.len() == 1 {
        shown[0].clone()
    } else {
        format!("({})", shown.join(", "))
    }
}
