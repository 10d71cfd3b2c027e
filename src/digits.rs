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

#[cfg(test)]
mod tests {
    use super::digits;

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
