//! Random numbers: one stream a run and source, so that switching one source off leaves the
//! others as they were.

use crate::numeric::mix;
use fastrand::Rng;
use std::f64::consts::TAU;

/// What is random.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Source {
    /// Motion at release.
    Release,
    /// Joint measurement.
    Encoder,
    /// Torque.
    Torque,
    /// Motion capture.
    Capture,
}

/// Normally distributed numbers.
#[derive(Debug, Clone)]
pub struct Noise {
    rng: Rng,
    spare: Option<f64>,
}

impl Noise {
    /// The stream of `source` in run `run` for `seed`.
    pub fn new(seed: u64, run: usize, source: Source) -> Self {
        let mixed = mix(mix(mix(seed) ^ run as u64) ^ source as u64);
        Self {
            rng: Rng::with_seed(mixed),
            spare: None,
        }
    }

    /// The next number of standard deviation `deviation` and mean zero.
    ///
    /// G. E. P. Box, M. E. Muller, doi:10.1214/aoms/1177706645.
    pub fn draw(&mut self, deviation: f64) -> f64 {
        if deviation == 0.0 {
            return 0.0;
        }
        let unit = self.spare.take().unwrap_or_else(|| {
            // In (0, 1], so that the logarithm is finite.
            let radius = (-2.0 * (1.0 - self.rng.f64()).ln()).sqrt();
            let (sin, cos) = (TAU * self.rng.f64()).sin_cos();
            self.spare = Some(radius * sin);
            radius * cos
        });
        deviation * unit
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_normal_and_streams_their_own() {
        let mut noise = Noise::new(3, 0, Source::Torque);
        let count = 100_000;
        let values: Vec<f64> = (0..count).map(|_| noise.draw(2.0)).collect();
        let mean = values.iter().sum::<f64>() / f64::from(count);
        let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / f64::from(count);
        let beyond = values.iter().filter(|v| v.abs() > 4.0).count() as f64 / f64::from(count);
        assert!(mean.abs() < 0.03, "{mean}");
        assert!((variance - 4.0).abs() < 0.1, "{variance}");
        // Beyond two standard deviations.
        assert!((beyond - 0.0455).abs() < 0.003, "{beyond}");
        let first = |seed, run, source| Noise::new(seed, run, source).draw(1.0);
        let one = first(1, 0, Source::Torque);
        assert_eq!(one.to_bits(), first(1, 0, Source::Torque).to_bits());
        for other in [
            first(2, 0, Source::Torque),
            first(1, 1, Source::Torque),
            first(1, 0, Source::Capture),
        ] {
            assert!((one - other).abs() > 1e-6, "{one} {other}");
        }
    }
}
