//! Largest magnitudes of the figures of a problem: far above what any task has, and far below what
//! overflows in products. docs/problem-file.md says them.

/// Joint positions and rates, lengths and angles of goals: rad, m, rad/s, m/s.
pub(super) const POSITION: f64 = 1e9;
/// Durations, s: from a nanosecond to thirty thousand years.
pub(super) const DURATION: [f64; 2] = [1e-9, 1e12];
/// Momentum, kg m/s and kg m²/s.
pub(super) const MOMENTUM: f64 = 1e24;
/// Weights of the cost.
pub(super) const WEIGHT: f64 = 1e30;
/// Bounds; what is meant to be none is infinite.
pub(super) const BOUND: f64 = 1e18;
