//! How a figure is distributed over samples.

/// Parts of the samples at which quantiles are given.
const PARTS: [f64; 6] = [0.05, 0.5, 0.9, 0.95, 0.99, 1.0];

/// How a figure is distributed over samples.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Standard deviation, by one less than the number of samples; 0 of one sample.
    pub sd: f64,
    /// Standard error of the mean.
    pub mean_error: f64,
    /// Standard error of the standard deviation, by the fourth moment: no normal distribution is
    /// taken for granted.
    pub sd_error: f64,
    /// Smallest value.
    pub least: f64,
    /// Parts of the samples with the value that they do not exceed, the last the largest of all.
    pub quantiles: Vec<[f64; 2]>,
    /// The sample with the largest value, counted from 0.
    pub worst: u64,
}

impl Spread {
    /// Of `values`, one a sample, at least one.
    ///
    /// # Panics
    /// Where there is none.
    pub fn of(values: &[f64]) -> Self {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let moment = |power: i32| {
            let powers = values.iter().map(|value| (value - mean).powi(power));
            powers.sum::<f64>() / n
        };
        let (second, fourth) = (moment(2), moment(4));
        let sd = (second * n / (n - 1.0).max(1.0)).sqrt();
        let excess = (fourth - second * second).max(0.0);
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let largest = sorted[sorted.len() - 1];
        let worst = values.iter().position(|value| *value == largest);
        Self {
            mean,
            sd,
            mean_error: sd / n.sqrt(),
            sd_error: match sd > 0.0 {
                true => 0.5 * (excess / n).sqrt() / sd,
                false => 0.0,
            },
            least: sorted[0],
            quantiles: PARTS.map(|part| [part, quantile(&sorted, part)]).into(),
            worst: worst.unwrap_or(0) as u64,
        }
    }
}

/// Between the two samples that stand there.
fn quantile(sorted: &[f64], part: f64) -> f64 {
    let place = part * (sorted.len() - 1) as f64;
    let below = place.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_known_values() {
        let spread = Spread::of(&[3.0, 1.0, 2.0, 5.0, 4.0]);
        assert_eq!((spread.mean, spread.least, spread.worst), (3.0, 1.0, 3));
        assert!((spread.sd - 2.5f64.sqrt()).abs() < 1e-15);
        assert_eq!(spread.quantiles[1], [0.5, 3.0]);
        assert_eq!(spread.quantiles[5], [1.0, 5.0]);
        let one = Spread::of(&[2.0]);
        assert_eq!((one.mean, one.sd, one.sd_error), (2.0, 0.0, 0.0));
    }
}
