//! Seeded random values, each a function of the seed, the key it is for and the position of its row
//! alone: the same whatever else is drawn, and in any order.

use crate::config::distribution::Distribution;
use crate::numeric::standard_normal;
use sha2::{Digest, Sha256};

impl Distribution {
    /// The number for `key` in the row at `position`.
    pub(super) fn draw(&self, seed: u64, key: &str, position: u64) -> f64 {
        self.value(|attempt| uniforms(seed, key, position, attempt))
    }
}

/// A standard normal number, the `attempt`th for `key` in the row at `position`.
pub(super) fn normal(seed: u64, key: &str, position: u64, attempt: u64) -> f64 {
    standard_normal(uniforms(seed, key, position, attempt))
}

/// Two numbers between 0 and 1, both excluded.
fn uniforms(seed: u64, key: &str, position: u64, attempt: u64) -> [f64; 2] {
    let mut hash = Sha256::new();
    for number in [seed, position, attempt] {
        hash.update(number.to_le_bytes());
    }
    hash.update(key.as_bytes());
    let digest = hash.finalize();
    [0, 8].map(|at| {
        let bytes = digest[at..at + 8].try_into().expect("eight bytes");
        ((u64::from_le_bytes(bytes) >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
    })
}

/// The lower factor L of a covariance L·Lᵀ, by rows; `None` where the matrix is no covariance.
pub(super) fn cholesky(covariance: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    const ROUNDING: f64 = 1e-12;
    let n = covariance.len();
    let mut factor = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..=i {
            let done: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
            let left = covariance[i][j] - done;
            let size = (covariance[i][i] * covariance[j][j]).abs().sqrt();
            if (covariance[i][j] - covariance[j][i]).abs() > ROUNDING * size {
                return None;
            }
            factor[i][j] = if i == j {
                // Nothing is left where one key is a combination of those before it.
                match left > ROUNDING * size {
                    true => left.sqrt(),
                    false if left >= -ROUNDING * size => 0.0,
                    false => return None,
                }
            } else if factor[j][j] > 0.0 {
                left / factor[j][j]
            } else if left.abs() <= ROUNDING.sqrt() * size {
                0.0
            } else {
                return None;
            };
        }
    }
    Some(factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn many(distribution: &Distribution) -> Vec<f64> {
        (0..20_000).map(|i| distribution.draw(7, "a", i)).collect()
    }

    fn mean_and_sd(values: &[f64]) -> (f64, f64) {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / n;
        (mean, variance.sqrt())
    }

    #[test]
    fn moments_are_those_of_the_distributions() {
        // Standard errors at 20,000 draws are 0.007 of a standard deviation.
        let (mean, sd) = mean_and_sd(&many(&Distribution::Uniform([2.0, 5.0])));
        assert!((mean - 3.5).abs() < 0.03 && (sd - 3.0 / 12f64.sqrt()).abs() < 0.03);
        let logs: Vec<f64> = many(&Distribution::LogUniform([1e-3, 1e3]))
            .iter()
            .map(|v| v.log10())
            .collect();
        let (mean, sd) = mean_and_sd(&logs);
        assert!(mean.abs() < 0.06 && (sd - 6.0 / 12f64.sqrt()).abs() < 0.06);
        let range = [f64::NEG_INFINITY, f64::INFINITY];
        let normal = Distribution::Normal {
            mean: 1.0,
            sd: 2.0,
            range,
        };
        let (mean, sd) = mean_and_sd(&many(&normal));
        assert!((mean - 1.0).abs() < 0.05 && (sd - 2.0).abs() < 0.05);
        // Half a normal distribution: mean √(2/π), variance 1 − 2/π.
        let half = Distribution::Normal {
            mean: 0.0,
            sd: 1.0,
            range: [0.0, f64::INFINITY],
        };
        let (mean, sd) = mean_and_sd(&many(&half));
        let expected = (2.0 / std::f64::consts::PI).sqrt();
        assert!(
            (mean - expected).abs() < 0.02
                && (sd - (1.0 - expected * expected).sqrt()).abs() < 0.02
        );
        assert!(many(&half).iter().all(|v| *v >= 0.0));
    }

    #[test]
    fn keys_seeds_and_rows_have_numbers_of_their_own() {
        let uniform = Distribution::Uniform([0.0, 1.0]);
        let first = uniform.draw(7, "a", 0);
        assert_eq!(first, uniform.draw(7, "a", 0));
        for other in [
            uniform.draw(8, "a", 0),
            uniform.draw(7, "b", 0),
            uniform.draw(7, "a", 1),
        ] {
            assert_ne!(first, other);
        }
        let pairs = (0..20_000).map(|i| (uniform.draw(7, "a", i), uniform.draw(7, "b", i)));
        let product = pairs.map(|(a, b)| (a - 0.5) * (b - 0.5)).sum::<f64>() / 20_000.0;
        // Without correlation: within four standard errors of zero.
        assert!(product.abs() < 4.0 / 12.0 / 20_000f64.sqrt(), "{product}");
    }

    #[test]
    fn a_covariance_has_a_factor_and_other_matrices_have_none() {
        let covariance = vec![vec![4.0, 2.0], vec![2.0, 5.0]];
        assert_eq!(cholesky(&covariance).unwrap(), [[2.0, 0.0], [1.0, 2.0]]);
        // One key twice the other.
        let flat = vec![vec![1.0, 2.0], vec![2.0, 4.0]];
        assert_eq!(cholesky(&flat).unwrap(), [[1.0, 0.0], [2.0, 0.0]]);
        for no_covariance in [
            [[1.0, 2.0], [2.0, 1.0]],
            [[1.0, 0.5], [0.4, 1.0]],
            [[-1.0, 0.0], [0.0, 1.0]],
        ] {
            let rows: Vec<Vec<f64>> = no_covariance.iter().map(|row| row.to_vec()).collect();
            assert_eq!(cholesky(&rows), None);
        }
    }
}
