//! The quintic timing law: rates and accelerations vanish at both ends.

/// The share of the way at `t` of `duration` seconds, 10p³ − 15p⁴ + 6p⁵ with p = t/duration, and
/// its first two derivatives by time.
pub(crate) fn quintic(t: f64, duration: f64) -> [f64; 3] {
    let p = t / duration;
    [
        p * p * p * (10.0 + p * (6.0 * p - 15.0)),
        30.0 * p * p * (1.0 - p) * (1.0 - p) / duration,
        60.0 * p * (1.0 - p) * (1.0 - 2.0 * p) / (duration * duration),
    ]
}
