//! What a run comes to, and how runs scatter.

use super::run::Run;
use crate::numeric::raise_or_nan;

/// How far the base moved from where it was first seen; displacements are of the tracked point.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Figures {
    /// Largest magnitude of the attitude, rad.
    pub max_attitude: f64,
    /// Attitude at the end, rad.
    pub final_attitude: f64,
    /// Largest distance, m.
    pub max_displacement: f64,
    /// Displacement at the end, inertial x and y, m.
    pub final_displacement: [f64; 2],
}

impl Figures {
    /// Of the poses x, y, attitude in order of time.
    pub fn of(poses: &[[f64; 3]]) -> Self {
        let (Some(first), Some(last)) = (poses.first(), poses.last()) else {
            return Self::default();
        };
        let mut found = Self {
            final_attitude: last[2] - first[2],
            final_displacement: [last[0] - first[0], last[1] - first[1]],
            ..Self::default()
        };
        for [x, y, attitude] in poses {
            raise_or_nan(&mut found.max_attitude, (attitude - first[2]).abs());
            let distance = (x - first[0]).hypot(y - first[1]);
            raise_or_nan(&mut found.max_displacement, distance);
        }
        found
    }

    /// Of the measurement of a run.
    pub fn measured(run: &Run) -> Self {
        Self::of(&run.measured)
    }

    /// Distance at the end, m.
    pub fn final_distance(&self) -> f64 {
        self.final_displacement[0].hypot(self.final_displacement[1])
    }
}

/// One figure over several runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Standard deviation, by one less than the number of runs; zero for one run.
    pub deviation: f64,
    /// Smallest.
    pub min: f64,
    /// Largest.
    pub max: f64,
}

impl Spread {
    /// Of at least one value; NaN where one is.
    pub fn of(values: impl Iterator<Item = f64> + Clone) -> Self {
        let count = values.clone().count();
        let mean = values.clone().sum::<f64>() / count as f64;
        let (mut min, mut max) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.clone() {
            if value.is_nan() || value < min {
                min = value;
            }
            raise_or_nan(&mut max, value);
        }
        let squares: f64 = values.map(|value| (value - mean).powi(2)).sum();
        Self {
            mean,
            deviation: (squares / count.saturating_sub(1).max(1) as f64).sqrt(),
            min,
            max,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_count_from_the_first_pose() {
        let found = Figures::of(&[[1.0, 1.0, 0.1], [4.0, 5.0, -0.5], [1.0, 2.0, 0.2]]);
        assert!((found.max_attitude - 0.6).abs() < 1e-15);
        assert!((found.final_attitude - 0.1).abs() < 1e-15);
        assert_eq!(found.max_displacement, 5.0);
        assert_eq!(found.final_displacement, [0.0, 1.0]);
    }

    #[test]
    fn spread_of_one_run_is_nothing() {
        let one = Spread::of([3.0].into_iter());
        assert_eq!(
            (one.mean, one.deviation, one.min, one.max),
            (3.0, 0.0, 3.0, 3.0)
        );
        let two = Spread::of([1.0, 3.0].into_iter());
        assert_eq!((two.mean, two.min, two.max), (2.0, 1.0, 3.0));
        assert!((two.deviation - 2f64.sqrt()).abs() < 1e-15);
    }
}
