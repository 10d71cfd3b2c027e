//! The instants at which a motion is wanted.

use crate::transcription::Discretization;

/// Most rows of a table: some hundred megabytes for a robot of seven joints.
pub const MOST_ROWS: usize = 1_000_000;

/// Fractions of a duration closer than this are one instant.
const SAME: f64 = 1e-12;

/// A rate of samples that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RateError {
    /// It is no rate.
    #[error("a rate of {0} Hz; expected a positive number")]
    NotPositive(f64),
    /// It asks for more than can be held.
    #[error(
        "a rate of {rate} Hz over {duration} s makes more than {MOST_ROWS} rows; expected a lower one"
    )]
    TooMany {
        /// The rate, Hz.
        rate: f64,
        /// Duration of the motion, s.
        duration: f64,
    },
}

/// Which instants.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Times {
    /// Those of the nodes, t_f the last.
    Nodes,
    /// Those of the nodes, and so many between each two as to divide the time there into this many parts.
    Divided(usize),
    /// So many a second from the start on, and t_f.
    Rate(f64),
}

impl Times {
    /// Fractions of the duration, rising from 0 to 1.
    ///
    /// # Errors
    /// [`RateError`] for a rate that is not positive or makes more than [`MOST_ROWS`] rows.
    pub fn fractions(self, plan: &Discretization) -> Result<Vec<f64>, RateError> {
        let nodes = plan.mesh.node_fractions();
        match self {
            Self::Nodes => Ok(nodes),
            Self::Divided(parts) => Ok(divided(&nodes, parts)),
            Self::Rate(rate) => even_times(rate, plan.duration),
        }
    }
}

fn divided(nodes: &[f64], parts: usize) -> Vec<f64> {
    let mut all = Vec::with_capacity(nodes.len() * parts);
    for pair in nodes.windows(2) {
        let step = (pair[1] - pair[0]) / parts as f64;
        all.extend((0..parts).map(|k| pair[0] + k as f64 * step));
    }
    all.push(1.0);
    all
}

/// Fractions of `duration` (s) at `rate` a second, and 1.
///
/// # Errors
/// [`RateError`] for a rate that is not positive or makes more than [`MOST_ROWS`] rows.
pub fn even_times(rate: f64, duration: f64) -> Result<Vec<f64>, RateError> {
    if !(rate > 0.0 && rate.is_finite()) {
        return Err(RateError::NotPositive(rate));
    }
    let steps = rate * duration;
    if steps.is_nan() || steps + 2.0 > MOST_ROWS as f64 {
        return Err(RateError::TooMany { rate, duration });
    }
    let mut fractions: Vec<f64> = (0..)
        .map(|k| f64::from(k) / steps)
        .take_while(|fraction| *fraction < 1.0 - SAME)
        .collect();
    if fractions.is_empty() {
        fractions.push(0.0);
    }
    fractions.push(1.0);
    Ok(fractions)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_times_end_at_the_end() {
        assert_eq!(even_times(2.0, 1.0).unwrap(), [0.0, 0.5, 1.0]);
        assert_eq!(even_times(2.0, 1.25).unwrap(), [0.0, 0.4, 0.8, 1.0]);
        // A tenth of a second is not a multiple of itself in binary.
        assert_eq!(even_times(10.0, 0.3).unwrap().len(), 4);
        assert_eq!(even_times(0.01, 1.0).unwrap(), [0.0, 1.0]);
    }

    #[test]
    fn rates_that_cannot_be_are_refused() {
        for rate in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                even_times(rate, 1.0),
                Err(RateError::NotPositive(_))
            ));
        }
        assert!(matches!(
            even_times(1e9, 1.0),
            Err(RateError::TooMany { .. })
        ));
        assert!(matches!(even_times(1e-300, 1.0), Ok(fractions) if fractions.len() == 2));
    }

    #[test]
    fn divisions_keep_the_nodes() {
        assert_eq!(divided(&[0.0, 0.5, 1.0], 2), [0.0, 0.25, 0.5, 0.75, 1.0]);
    }
}
