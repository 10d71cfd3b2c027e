//! What a planar motion comes to, in the figures that the paper gives.

use super::{Case, Sample, Sampler};
use serde::Serialize;

/// Extremes of a planar motion; angles in degrees, lengths in cm.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Extremes {
    /// Largest magnitude of the base attitude, between the nodes as well.
    pub largest_attitude: f64,
    /// Base attitude at the end.
    pub final_attitude: f64,
    /// Largest displacement of the base along x and y.
    pub largest_displacement: [f64; 2],
    /// Displacement of the base along x and y at the end.
    pub final_displacement: [f64; 2],
    /// What the end would be if the base had not turned: the mass centre seen from the base.
    pub unturned_displacement: [f64; 2],
    /// Whether the base turns back on the way: its attitude falls in magnitude by more than 1°.
    pub returns: bool,
    /// Whether a joint turns against the sense of its goal on the way, by more than 0.1°.
    pub opposite: bool,
}

impl Extremes {
    /// Those of `case`; `None` where its motion is not planar.
    pub fn of(case: &Case) -> Option<Self> {
        let samples = Sampler::new(case)?.samples();
        let (first, last) = (samples.first()?, samples.last()?);
        let largest = |value: &dyn Fn(&Sample) -> f64| {
            samples
                .iter()
                .map(|sample| value(sample).abs())
                .fold(0.0, f64::max)
        };
        let moved = |sample: &Sample, i: usize| 100.0 * (sample.position[i] - first.position[i]);
        let against = |sample: &Sample| {
            let ends = sample.joints.iter().zip(&last.joints);
            ends.into_iter().any(|(q, end)| q * end.signum() < -0.1)
        };
        let mut highest: f64 = 0.0;
        let returns = samples.iter().any(|sample| {
            highest = highest.max(sample.attitude.abs());
            sample.attitude.abs() < highest - 1.0
        });
        // Base position and mass centre change places with their sign and the base's turn.
        let (s, c) = last.attitude.to_radians().sin_cos();
        let [x, y] = last.position;
        let still = [c * x + s * y, c * y - s * x];
        Some(Self {
            largest_attitude: largest(&|sample| sample.attitude),
            final_attitude: last.attitude,
            largest_displacement: [0, 1].map(|i| largest(&|sample| moved(sample, i))),
            final_displacement: [0, 1].map(|i| moved(last, i)),
            unturned_displacement: [0, 1].map(|i| 100.0 * (still[i] - first.position[i])),
            returns,
            opposite: samples.iter().any(against),
        })
    }

    /// In words, for a caption.
    pub fn describe(&self) -> String {
        let [x, y] = self.largest_displacement;
        format!(
            "Base attitude at most {:.1}°, at the end {:.1}°; displacement at most {x:.2} cm along x \
             and {y:.2} cm along y; on the way the base {} back, and {} against the sense of its \
             goal.",
            self.largest_attitude,
            self.final_attitude,
            if self.returns { "turns" } else { "never turns" },
            if self.opposite {
                "a joint turns"
            } else {
                "no joint turns"
            }
        )
        .replace('-', "−")
    }
}
