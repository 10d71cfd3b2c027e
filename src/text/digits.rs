//! Numbers with as many digits as their size needs: what is not zero is never shown as zero.

/// Decimals beyond those asked for, from which on a power of ten is read more easily.
const MORE: usize = 3;
/// Size from which on a number is shown by a power of ten.
const HUGE: f64 = 1e9;

/// `value` with that many decimals, or more where fewer than `significant` digits of it would be
/// left; by a power of ten where it is far smaller or larger than that.
pub(crate) fn digits(value: f64, decimals: usize, significant: usize) -> String {
    let size = value.abs();
    if size == 0.0 {
        return format!("{:.decimals$}", 0.0);
    }
    if !size.is_finite() {
        return value.to_string();
    }
    let leading = size.log10().floor();
    let needed = significant as f64 - 1.0 - leading;
    if size >= HUGE || needed > (decimals + MORE) as f64 {
        let after_first = significant.saturating_sub(1);
        return format!("{value:.after_first$e}");
    }
    let decimals = decimals.max(needed.max(0.0) as usize);
    format!("{value:.decimals$}")
}

/// Powers of ten up to this are exact, and so what is nearest to a quotient by them is found.
const EXACT: i32 = 22;

/// The number nearest to `value` that has `significant` digits; no negative zero. Its shortest text is that
/// number's, and takes less time to find than a text with so many digits.
pub(crate) fn rounded(value: f64, significant: i32) -> f64 {
    if value == 0.0 {
        return 0.0;
    }
    let shift = significant - 1 - value.abs().log10().floor() as i32;
    if shift.abs() > EXACT {
        let text = format!("{value:.*e}", (significant - 1).max(0) as usize);
        return text.parse().unwrap_or(value);
    }
    let power = 10.0_f64.powi(shift.abs());
    match shift >= 0 {
        true => (value * power).round() / power,
        false => (value / power).round() * power,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rounded_number_is_that_of_its_digits() {
        let mut random = fastrand::Rng::with_seed(3);
        for _ in 0..100_000 {
            let value = (random.f64() - 0.5) * 10_f64.powi(random.i32(-40..40));
            let text = format!("{value:.5e}");
            assert_eq!(rounded(value, 6), text.parse::<f64>().unwrap(), "{value:e}");
        }
        assert_eq!(rounded(9.999996, 6).to_string(), "10");
        assert_eq!(rounded(-0.0, 6).to_string(), "0");
        assert!(rounded(f64::NAN, 6).is_nan() && rounded(f64::INFINITY, 6).is_infinite());
    }

    #[test]
    fn what_is_not_zero_is_not_shown_as_zero() {
        for (value, decimals, significant, shown) in [
            (29.1942, 2, 3, "29.19"),
            (-1.5, 2, 3, "-1.50"),
            (0.9, 2, 3, "0.900"),
            (0.00495, 2, 3, "0.00495"),
            (4.95e-4, 2, 3, "4.95e-4"),
            (-2.5e-300, 2, 3, "-2.50e-300"),
            (0.0, 2, 3, "0.00"),
            (-0.0, 3, 2, "0.000"),
            (0.012, 3, 2, "0.012"),
            (0.0047, 3, 2, "0.0047"),
            (3e12, 2, 3, "3.00e12"),
            (f64::INFINITY, 2, 3, "inf"),
        ] {
            assert_eq!(digits(value, decimals, significant), shown);
        }
        for exponent in -320..309 {
            let value = 1.234 * 10f64.powi(exponent);
            let read: f64 = digits(value, 2, 3).parse().unwrap();
            assert!((read - value).abs() <= 0.005 * value, "{value:e}");
        }
    }
}
