//! The joints' tracking errors over time: Fourier sums over the duration of the plan.

use std::f64::consts::TAU;

/// Whole cycles over the motion of the fastest part of a tracking error. What comes and goes faster
/// averages out in the base's motion.
pub const HARMONICS: usize = 4;

/// The harmonics of tracking errors at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct HarmonicsAt {
    /// Cosine and sine of each.
    pub value: [[f64; 2]; HARMONICS],
    /// Their rates, 1/s.
    pub rate: [[f64; 2]; HARMONICS],
}

impl HarmonicsAt {
    /// At a fraction of the duration, s.
    pub fn new(fraction: f64, duration: f64) -> Self {
        let mut at = Self {
            value: [[0.0; 2]; HARMONICS],
            rate: [[0.0; 2]; HARMONICS],
        };
        for k in 0..HARMONICS {
            let cycles = (k + 1) as f64;
            let (sin, cos) = (TAU * cycles * fraction).sin_cos();
            let frequency = TAU * cycles / duration;
            at.value[k] = [cos, sin];
            at.rate[k] = [-frequency * sin, frequency * cos];
        }
        at
    }
}

/// Part of a drawn tracking error that each harmonic has: of normal ones with mean zero the sum then
/// has their standard deviation at every instant.
pub(super) fn part_of_tracking() -> f64 {
    1.0 / (HARMONICS as f64).sqrt()
}
