//! The figures of a dispersion: how they are called, in what unit a person reads them.

use crate::study::dispersion::{Figures, Spread};
use crate::system::Metrics;

/// What a figure is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// rad, shown in degrees.
    Angle,
    /// m, shown in centimetres.
    Length,
}

impl Measure {
    /// The unit a person reads.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Angle => "°",
            Self::Length => "cm",
        }
    }

    /// How many of that are one of the file's.
    pub fn factor(self) -> f64 {
        match self {
            Self::Angle => 1f64.to_degrees(),
            Self::Length => 100.0,
        }
    }
}

/// Bars of a histogram.
const BARS: usize = 40;

/// A figure over all samples.
#[derive(Debug, Clone)]
pub struct DispersedFigure {
    /// Its name in files.
    pub name: &'static str,
    /// What a person calls it.
    pub title: &'static str,
    pub measure: Measure,
    /// The plan's own, in the file's unit.
    pub planned: f64,
    pub spread: Spread,
    /// Samples in each of even parts between the least and the largest value.
    pub histogram: Vec<u64>,
}

/// All figures of `samples`, beside those of the plan.
pub fn figures(planned: &Metrics, samples: &[Figures]) -> Vec<DispersedFigure> {
    type Of = fn(&Figures) -> f64;
    let all: [(&str, &str, Measure, f64, Of); 5] = [
        (
            "max_base_attitude",
            "largest base angle",
            Measure::Angle,
            planned.max_base_attitude,
            |found| found.max_base_attitude,
        ),
        (
            "final_base_attitude",
            "final base angle",
            Measure::Angle,
            planned.final_base_attitude,
            |found| found.final_base_attitude,
        ),
        (
            "departure",
            "final attitude off the plan",
            Measure::Angle,
            0.0,
            Figures::departure_angle,
        ),
        (
            "max_base_displacement",
            "largest base displacement",
            Measure::Length,
            planned.max_base_displacement,
            |found| found.max_base_displacement,
        ),
        (
            "final_base_displacement",
            "final base displacement",
            Measure::Length,
            planned.final_base_displacement,
            |found| found.final_base_displacement,
        ),
    ];
    let figure = |(name, title, measure, planned, of): (_, _, _, _, Of)| {
        let values: Vec<f64> = samples.iter().map(of).collect();
        let spread = Spread::of(&values);
        DispersedFigure {
            name,
            title,
            measure,
            planned,
            histogram: histogram(&values, &spread),
            spread,
        }
    };
    all.into_iter().map(figure).collect()
}

fn histogram(values: &[f64], spread: &Spread) -> Vec<u64> {
    let (first, last) = (spread.least, largest(spread));
    let mut counts = vec![0; BARS];
    for value in values {
        let part = (value - first) / (last - first);
        // All in the first where they are equal.
        counts[((part * BARS as f64) as usize).min(BARS - 1)] += 1;
    }
    counts
}

/// The largest value.
pub fn largest(spread: &Spread) -> f64 {
    spread
        .quantiles
        .last()
        .map_or(f64::NAN, |[_, value]| *value)
}
