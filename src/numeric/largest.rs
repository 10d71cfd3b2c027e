//! The largest of several numbers, among which one that is not a number must not get lost.
//!
//! [`f64::max`] drops NaN, so that a maximum of errors would look small exactly where nothing is
//! known. Here NaN wins: the result fails every comparison with a tolerance.

/// The largest of `values`, which are at least 0; NaN where one of them is NaN, 0 of none.
pub(crate) fn largest_or_nan(values: impl IntoIterator<Item = f64>) -> f64 {
    let mut largest = 0.0;
    for value in values {
        raise_or_nan(&mut largest, value);
    }
    largest
}

/// Raises `largest` to `value` where that is larger or NaN; a NaN stays.
pub(crate) fn raise_or_nan(largest: &mut f64, value: f64) {
    if value.is_nan() || value > *largest {
        *largest = value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nan_is_not_lost() {
        assert_eq!(largest_or_nan([1.0, 3.0, 2.0]), 3.0);
        assert_eq!(largest_or_nan([]), 0.0);
        assert_eq!(largest_or_nan([1.0, f64::INFINITY]), f64::INFINITY);
        for values in [
            [f64::NAN, 1.0, 2.0],
            [1.0, f64::NAN, 2.0],
            [1.0, 2.0, f64::NAN],
        ] {
            assert!(largest_or_nan(values).is_nan(), "{values:?}");
        }
    }
}
