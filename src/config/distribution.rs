//! Distributions of a number, whatever it is for and wherever its random numbers come from.

use crate::numeric::standard_normal;
use std::f64::consts::TAU;
use std::fmt;

/// How a number is drawn.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Distribution {
    /// Always this one.
    Fixed(f64),
    /// Evenly between the two.
    Uniform([f64; 2]),
    /// Its logarithm evenly between those of the two, both above zero.
    LogUniform([f64; 2]),
    /// Normal, drawn again while outside of the range.
    Normal {
        /// Mean of the whole distribution.
        mean: f64,
        /// Standard deviation of the whole distribution.
        sd: f64,
        /// Least and largest value; infinite where there is none.
        range: [f64; 2],
    },
}

/// Least part of a normal distribution within its range: below it a typing error is more likely than
/// a wish.
pub(super) const LEAST_INSIDE: f64 = 0.01;
/// Draws before a normal number is taken at the nearer end of its range; with [`LEAST_INSIDE`] none
/// ever gets there.
const MOST_DRAWS: u64 = 10_000;

impl Distribution {
    /// A normal distribution over all numbers.
    pub fn normal(mean: f64, sd: f64) -> Self {
        Self::Normal {
            mean,
            sd,
            range: [f64::NEG_INFINITY, f64::INFINITY],
        }
    }

    /// The number that `uniforms` leads to: two numbers between 0 and 1, both excluded, for each
    /// attempt, counted from 0.
    pub fn value(&self, uniforms: impl Fn(u64) -> [f64; 2]) -> f64 {
        match *self {
            Self::Fixed(value) => value,
            Self::Uniform([a, b]) => a + (b - a) * uniforms(0)[0],
            Self::LogUniform([a, b]) => {
                let part = uniforms(0)[0];
                // Rounding may not lead out of the range.
                (a.ln() + (b.ln() - a.ln()) * part).exp().clamp(a, b)
            }
            Self::Normal {
                mean,
                sd,
                range: [low, high],
            } => {
                let draws = (0..MOST_DRAWS).map(|n| mean + sd * standard_normal(uniforms(n)));
                let mut inside = draws.filter(|drawn| (low..=high).contains(drawn));
                inside.next().unwrap_or(mean.clamp(low, high))
            }
        }
    }

    /// Whether only one value is ever drawn.
    pub fn is_fixed(&self) -> bool {
        match *self {
            Self::Fixed(_) => true,
            Self::Uniform([a, b]) | Self::LogUniform([a, b]) => a == b,
            Self::Normal { sd, .. } => sd == 0.0,
        }
    }

    /// The part of it that is at most zero, before anything is drawn again.
    pub(super) fn part_below_zero(&self) -> f64 {
        match *self {
            Self::Fixed(value) => f64::from(value <= 0.0),
            Self::LogUniform(_) => 0.0,
            Self::Uniform([a, b]) if a < b => ((-a).max(0.0) / (b - a)).min(1.0),
            Self::Uniform([a, _]) => f64::from(a <= 0.0),
            Self::Normal { mean, sd, range } if sd > 0.0 => {
                let [low, high] = range.map(|end| (end - mean) / sd);
                inside(low, high.min(-mean / sd))
            }
            Self::Normal { mean, .. } => f64::from(mean <= 0.0),
        }
    }
}

/// As it is written on the command line.
impl fmt::Display for Distribution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Fixed(value) => write!(f, "fixed({value})"),
            Self::Uniform([a, b]) => write!(f, "uniform({a}, {b})"),
            Self::LogUniform([a, b]) => write!(f, "log_uniform({a}, {b})"),
            Self::Normal { mean, sd, range } => {
                write!(f, "normal({mean}, {sd}")?;
                if range != [f64::NEG_INFINITY, f64::INFINITY] {
                    write!(f, ", {}, {}", range[0], range[1])?;
                }
                f.write_str(")")
            }
        }
    }
}

/// The part of a standard normal distribution between `low` and `high`, to some digits.
pub(super) fn inside(low: f64, high: f64) -> f64 {
    const STEPS: usize = 2_000;
    const FAR: f64 = 10.0;
    let (low, high) = (low.max(-FAR), high.min(FAR));
    if low >= high {
        return 0.0;
    }
    let step = (high - low) / STEPS as f64;
    let density = |z: f64| (-0.5 * z * z).exp() / TAU.sqrt();
    let middles = (0..STEPS).map(|k| low + (k as f64 + 0.5) * step);
    middles.map(density).sum::<f64>() * step
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_normal_distribution() {
        assert!((inside(-1.0, 1.0) - 0.682_689_492).abs() < 1e-6);
        assert!((inside(0.0, f64::INFINITY) - 0.5).abs() < 1e-6);
        assert!(inside(5.0, 6.0) < 1e-6);
    }

    #[test]
    fn parts_below_zero() {
        let part = |distribution: Distribution| distribution.part_below_zero();
        assert_eq!(part(Distribution::Fixed(0.0)), 1.0);
        assert_eq!(part(Distribution::Uniform([-1.0, 3.0])), 0.25);
        assert!((part(Distribution::normal(1.0, 1.0)) - 0.158_655_25).abs() < 1e-6);
        assert!(part(Distribution::normal(1.0, 0.01)) < 1e-12);
    }
}
