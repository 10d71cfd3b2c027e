//! How far something gets whose speed and acceleration are limited.

/// The farthest way in the time `width`, s, at a speed of at most `most`, and of at most `ends` at
/// the beginning and at the end, from where it rises by at most `slope` a second. Infinite limits are
/// none.
pub(super) fn farthest(width: f64, most: f64, slope: f64, ends: [f64; 2]) -> f64 {
    if slope == f64::INFINITY {
        return most * width;
    }
    if slope == 0.0 {
        return most.min(ends[0]).min(ends[1]) * width;
    }
    // The speed that can be reached and left again.
    let peak = 0.5 * (ends[0] + ends[1] + slope * width);
    let top = most.min(peak);
    let ramp = |speed: f64| {
        let from = speed.min(top);
        let time = (top - from) / slope;
        [time, 0.5 * (from + top) * time]
    };
    let [rise, up] = ramp(ends[0]);
    let [fall, down] = ramp(ends[1]);
    up + down + top * (width - rise - fall).max(0.0)
}

/// Speeds of at most `speeds` at `times`, s, each lowered to what the others leave at a change of at
/// most `slope` a second.
pub(super) fn compatible(times: &[f64], speeds: &[f64], slope: f64) -> Vec<f64> {
    let pairs = || times.iter().zip(speeds);
    let least = |t: f64| {
        let from = pairs().map(|(&at, &speed)| match t == at {
            true => speed,
            false => speed + slope * (t - at).abs(),
        });
        from.fold(f64::INFINITY, f64::min)
    };
    times.iter().map(|&t| least(t)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_near(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-12, "{found} for {expected}");
    }

    #[test]
    fn ways_worked_by_hand() {
        const NONE: f64 = f64::INFINITY;
        // A triangle, a trapezium, a rectangle; with a flying start, and one that is braked.
        assert_near(farthest(4.0, NONE, 2.0, [0.0; 2]), 8.0);
        assert_near(farthest(4.0, 1.0, 2.0, [0.0; 2]), 3.5);
        assert_near(farthest(4.0, 1.0, NONE, [0.0; 2]), 4.0);
        assert_near(farthest(4.0, 1.0, 2.0, [1.0, 0.0]), 3.75);
        assert_near(farthest(1.0, NONE, 2.0, [2.0, 0.0]), 1.0);
        assert_near(farthest(4.0, 1.0, 0.0, [0.0; 2]), 0.0);
        assert_near(farthest(4.0, 0.0, 2.0, [0.0; 2]), 0.0);
    }

    #[test]
    fn speeds_that_follow_each_other() {
        let found = compatible(&[0.0, 1.0, 4.0], &[0.0, f64::INFINITY, 1.0], 0.5);
        assert_eq!(found, [0.0, 0.5, 1.0]);
        let none = compatible(&[0.0, 1.0], &[0.0, f64::INFINITY], f64::INFINITY);
        assert_eq!(none, [0.0, f64::INFINITY]);
    }
}
