//! How many points a segment gets when its degree is raised, eq. (32).

use crate::refine::Settings;

/// ⌈log₁₀ e − log₁₀ ε⌉ of (30) and (32), at least 1 for an error above the tolerance; 1 where
/// the error is not finite, since nothing is known of its size.
pub(super) fn decades(error: f64, tolerance: f64) -> f64 {
    let decades = (error.log10() - tolerance.log10()).ceil();
    if decades.is_finite() {
        decades.max(1.0)
    } else {
        1.0
    }
}

/// N* of (32): the points of a segment of `points` whose error is above the tolerance, at least
/// one more than it has.
pub(super) fn raised(settings: &Settings, points: usize, error: f64) -> usize {
    let more = settings.lambda2 * decades(error, settings.tolerance);
    points + (more.round() as usize).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_follow_equation_32() {
        let settings = Settings {
            tolerance: 1e-5,
            lambda2: 3.0,
            ..Settings::default()
        };
        // e = 4·10⁻⁴: log₁₀ e = −3.398, less −5 is 1.602, rounded up 2; N* = 5 + 3·2 = 11.
        assert_eq!(raised(&settings, 5, 4e-4), 11);
        // e = 2·10⁻⁵: −4.699 + 5 = 0.301, rounded up 1; N* = 8 + 3 = 11.
        assert_eq!(raised(&settings, 8, 2e-5), 11);
        // λ₂ = 1/5: 0.2·1 rounds to no point, but one more there must be.
        let timid = Settings {
            lambda2: 0.2,
            ..settings.clone()
        };
        assert_eq!(raised(&timid, 8, 2e-5), 9);
        // Nothing is known of an error that is not a number: one decade.
        assert_eq!(raised(&settings, 5, f64::NAN), 8);
        assert_eq!(raised(&settings, 5, f64::INFINITY), 8);
    }
}
