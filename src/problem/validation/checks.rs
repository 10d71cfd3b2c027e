//! Checks that several parts of a problem share.

use crate::ocp::Interval;
use crate::problem::error::ProblemError;
use crate::problem::magnitude;

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

/// `expected` finite numbers, one for each of `what`, none of a magnitude above `most`.
pub(super) fn numbers(
    key: &str,
    values: &[f64],
    (expected, what): (usize, &str),
    most: f64,
) -> Checked {
    count(key, values.len(), expected, what)?;
    for (i, value) in values.iter().enumerate() {
        number(&indexed(key, i, expected), *value, most)?;
    }
    Ok(())
}

/// A finite number of a magnitude up to `most`.
pub(super) fn number(key: &str, value: f64, most: f64) -> Checked {
    if !value.is_finite() {
        return Err(error(key, value, "a finite number"));
    }
    if value.abs() > most {
        let expected = format!("a number of a magnitude up to {most:e}");
        return Err(error(key, format!("{value:e}"), expected));
    }
    Ok(())
}

/// A finite weight, zero or above.
pub(super) fn weight(key: impl Into<String>, weight: f64) -> Checked {
    let key = key.into();
    not_negative(&key, weight, "a finite weight, zero or above")?;
    number(&key, weight, magnitude::WEIGHT)
}

/// A finite length, zero or above.
pub(super) fn length(key: impl Into<String>, length: f64) -> Checked {
    let key = key.into();
    not_negative(&key, length, "a finite length, m, zero or above")?;
    number(&key, length, magnitude::POSITION)
}

fn not_negative(key: &str, value: f64, expected: &str) -> Checked {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(error(key, value, expected))
    }
}

/// Bounds that are numbers, infinite or of a magnitude that makes sense, the lower at most the upper.
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
    let most = magnitude::BOUND;
    let absurd = |bound: &f64| bound.is_finite() && bound.abs() > most;
    match [bounds.lower, bounds.upper].into_iter().find(absurd) {
        Some(bound) => {
            let expected = format!("bounds of a magnitude up to {most:e}, or inf for none");
            Err(error(key, format!("{bound:e}"), expected))
        }
        None => Ok(()),
    }
}
