//! Checks that several parts of a problem share.

use crate::ocp::Interval;
use crate::problem::error::ProblemError;

/// What came of a check.
pub(super) type Checked = Result<(), ProblemError>;

pub(super) fn error(
    key: impl Into<String>,
    found: impl ToString,
    expected: impl Into<String>,
) -> ProblemError {
    ProblemError {
        key: key.into(),
        found: found.to_string(),
        expected: expected.into(),
    }
}

/// The key of element `i`, or of the whole where there is only one.
pub(super) fn indexed(key: &str, i: usize, count: usize) -> String {
    if count == 1 {
        key.into()
    } else {
        format!("{key}[{i}]")
    }
}

/// As many values as there are of `what`.
pub(super) fn count(key: &str, found: usize, expected: usize, what: &str) -> Checked {
    if found == expected {
        return Ok(());
    }
    let noun = if found == 1 { "value" } else { "values" };
    Err(error(
        key,
        format!("{found} {noun}"),
        format!("{expected}, the number of {what}"),
    ))
}

/// `expected` finite numbers, one for each of `what`.
pub(super) fn numbers(key: &str, values: &[f64], expected: usize, what: &str) -> Checked {
    count(key, values.len(), expected, what)?;
    match values.iter().position(|value| !value.is_finite()) {
        Some(i) => Err(error(
            indexed(key, i, expected),
            values[i],
            "a finite number",
        )),
        None => Ok(()),
    }
}

/// A finite weight, zero or above.
pub(super) fn weight(key: impl Into<String>, weight: f64) -> Checked {
    not_negative(key, weight, "a finite weight, zero or above")
}

/// A finite length, zero or above.
pub(super) fn length(key: impl Into<String>, length: f64) -> Checked {
    not_negative(key, length, "a finite length, m, zero or above")
}

fn not_negative(key: impl Into<String>, value: f64, expected: &str) -> Checked {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(error(key, value, expected))
    }
}

/// Bounds that are numbers, the lower at most the upper.
pub(super) fn interval(key: &str, bounds: &Interval) -> Checked {
    if bounds.lower.is_nan() || bounds.upper.is_nan() {
        return Err(error(key, "not a number", "a lower and an upper bound"));
    }
    if bounds.lower > bounds.upper {
        let found = format!(
            "lower bound {} above upper bound {}",
            bounds.lower, bounds.upper
        );
        return Err(error(key, found, "lower at most upper"));
    }
    Ok(())
}
