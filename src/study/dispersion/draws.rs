//! Every number that is drawn, as a function of seed, key and sample alone: the same whatever else is
//! drawn, in whatever order, on however many threads.

use super::tracking::HARMONICS;
use crate::config::{Dispersed, Dispersion, Distribution};
use crate::numeric::mix;
use sha2::{Digest, Sha256};

/// Numbers of one quantity.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    pub quantity: Dispersed,
    pub key: String,
    pub distribution: Distribution,
    /// Its numbers among those of a sample.
    pub from: usize,
    /// A stream of random numbers for each of them.
    streams: Vec<u64>,
}

impl Entry {
    /// How many numbers it has.
    pub fn count(&self) -> usize {
        self.streams.len()
    }
}

/// All numbers of a sample.
#[derive(Debug, Clone)]
pub(super) struct Draws {
    pub entries: Vec<Entry>,
    /// Numbers of a sample.
    pub count: usize,
}

impl Draws {
    pub fn new(dispersion: &Dispersion, planar: bool, seed: u64) -> Self {
        let mut count = 0;
        let entries = dispersion.perturbations().iter().map(|perturbation| {
            let components = match perturbation.quantity {
                Dispersed::Com(_) | Dispersed::LinearMomentum => 2 + usize::from(!planar),
                Dispersed::Inertia(_) | Dispersed::AngularMomentum => 1 + 2 * usize::from(!planar),
                Dispersed::Tracking(_) => 2 * HARMONICS,
                _ => 1,
            };
            let from = count;
            count += components;
            Entry {
                quantity: perturbation.quantity,
                key: perturbation.key.clone(),
                distribution: perturbation.distribution.clone(),
                from,
                streams: (0..components)
                    .map(|component| stream(seed, &perturbation.key, component))
                    .collect(),
            }
        });
        Self {
            entries: entries.collect(),
            count,
        }
    }

    /// The numbers of the sample at `index`, each in its unit; length [`Self::count`].
    pub fn draw(&self, index: u64, values: &mut [f64]) {
        for entry in &self.entries {
            for (component, stream) in entry.streams.iter().enumerate() {
                values[entry.from + component] = entry
                    .distribution
                    .value(|attempt| uniforms(*stream, index, attempt));
            }
        }
    }
}

/// A stream far from those of all other keys.
fn stream(seed: u64, key: &str, component: usize) -> u64 {
    let mut hash = Sha256::new();
    for number in [seed, component as u64] {
        hash.update(number.to_le_bytes());
    }
    hash.update(key.as_bytes());
    let digest = hash.finalize();
    u64::from_le_bytes(digest[..8].try_into().expect("eight bytes"))
}

/// Two numbers between 0 and 1, both excluded.
fn uniforms(stream: u64, index: u64, attempt: u64) -> [f64; 2] {
    let first = mix(stream ^ mix(index ^ mix(attempt)));
    [first, mix(first ^ stream.rotate_left(32))]
        .map(|bits| ((bits >> 12) as f64 + 0.5) / (1_u64 << 52) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_even_and_independent() {
        let streams = [stream(7, "a", 0), stream(7, "a", 1), stream(8, "a", 0)];
        const COUNT: u64 = 100_000;
        let all = |s: u64| (0..COUNT).map(move |i| uniforms(s, i, 0));
        for s in streams {
            let mut sums = [0.0; 6];
            for [a, b] in all(s) {
                let (a, b) = (a - 0.5, b - 0.5);
                for (sum, value) in sums.iter_mut().zip([a, b, a * a, b * b, a * b, a * a * b]) {
                    *sum += value / COUNT as f64;
                }
            }
            let twelfth = 1.0 / 12.0;
            for (found, expected) in sums.iter().zip([0.0, 0.0, twelfth, twelfth, 0.0, 0.0]) {
                // Four standard errors.
                assert!((found - expected).abs() < 0.0037, "{sums:?}");
            }
        }
        for (s, t) in [(0, 1), (0, 2), (1, 2)] {
            let pairs = all(streams[s]).zip(all(streams[t]));
            let product: f64 = pairs.map(|(a, b)| (a[0] - 0.5) * (b[0] - 0.5)).sum();
            assert!((product / COUNT as f64).abs() < 4.0 / 12.0 / (COUNT as f64).sqrt());
        }
        assert_ne!(uniforms(1, 0, 0), uniforms(1, 0, 1));
    }
}
