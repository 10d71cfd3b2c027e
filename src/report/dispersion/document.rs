//! `dispersion.json` and `samples.csv`.

use super::DispersionReport;
use super::figure::largest;
use crate::config::Dispersion;
use crate::dynamics::Model;
use crate::solution::{Build, to_json};
use crate::study::dispersion::HARMONICS;
use serde::Serialize;

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    version: &'static str,
    name: &'a str,
    solution: &'a str,
    samples: usize,
    seed: u64,
    tracking_harmonics: usize,
    perturbations: Vec<Perturbation<'a>>,
    replay: Replay,
    figures: Vec<Figure<'a>>,
    sensitivities: Vec<Sensitivity<'a>>,
}

#[derive(Serialize)]
struct Perturbation<'a> {
    key: &'a str,
    unit: &'static str,
    nominal: f64,
    distribution: String,
}

#[derive(Serialize)]
struct Replay {
    steps: usize,
    evaluations: usize,
    step_error: f64,
    plan_drift_attitude: f64,
    plan_drift_position: f64,
}

#[derive(Serialize)]
struct Figure<'a> {
    name: &'a str,
    unit: &'static str,
    planned: f64,
    mean: f64,
    mean_error: f64,
    sd: f64,
    sd_error: f64,
    least: f64,
    quantiles: Vec<Quantile>,
    worst_sample: u64,
    histogram: Histogram<'a>,
}

#[derive(Serialize)]
struct Quantile {
    part: f64,
    value: f64,
}

#[derive(Serialize)]
struct Histogram<'a> {
    from: f64,
    to: f64,
    counts: &'a [u64],
}

#[derive(Serialize)]
struct Sensitivity<'a> {
    response: &'static str,
    explained: f64,
    shares: Vec<Share<'a>>,
}

#[derive(Serialize)]
struct Share<'a> {
    key: &'a str,
    share: f64,
    sd: f64,
}

impl DispersionReport<'_> {
    /// `dispersion.json`; docs/dispersion.md describes it.
    ///
    /// # Errors
    /// None that is expected: all keys are strings.
    pub fn json(&self) -> serde_json::Result<String> {
        let [steps, evaluations] = self.replays.steps();
        let [plan_drift_attitude, plan_drift_position] = self.replays.drift();
        to_json(&Document {
            schema: 1,
            version: Build::VERSION,
            name: &self.problem.name,
            solution: &self.solution,
            samples: self.samples.len(),
            seed: self.seed,
            tracking_harmonics: HARMONICS,
            perturbations: perturbations(self.dispersion, &self.problem.robot),
            replay: Replay {
                steps,
                evaluations,
                step_error: self.replays.step_error(),
                plan_drift_attitude,
                plan_drift_position,
            },
            figures: self.figures().collect(),
            sensitivities: self.sensitivities().collect(),
        })
    }

    fn figures(&self) -> impl Iterator<Item = Figure<'_>> {
        self.figures.iter().map(|figure| {
            let spread = &figure.spread;
            let quantiles = spread.quantiles.iter();
            Figure {
                name: figure.name,
                unit: match figure.measure {
                    super::figure::Measure::Angle => "rad",
                    super::figure::Measure::Length => "m",
                },
                planned: figure.planned,
                mean: spread.mean,
                mean_error: spread.mean_error,
                sd: spread.sd,
                sd_error: spread.sd_error,
                least: spread.least,
                quantiles: quantiles
                    .map(|[part, value]| Quantile {
                        part: *part,
                        value: *value,
                    })
                    .collect(),
                worst_sample: spread.worst,
                histogram: Histogram {
                    from: spread.least,
                    to: largest(spread),
                    counts: &figure.histogram,
                },
            }
        })
    }

    fn sensitivities(&self) -> impl Iterator<Item = Sensitivity<'_>> {
        self.sensitivities.iter().map(|found| Sensitivity {
            response: found.response.name(),
            explained: found.explained,
            shares: found
                .shares
                .iter()
                .map(|share| Share {
                    key: &share.key,
                    share: share.share,
                    sd: share.sd,
                })
                .collect(),
        })
    }

    /// `samples.csv`, a row a sample: its number and its figures, rad and m.
    pub fn csv(&self) -> String {
        let mut text = String::from(
            "sample,max_base_attitude,final_base_attitude,max_base_displacement,\
             final_base_displacement,departure_x,departure_y,departure_z\n",
        );
        for (index, found) in self.samples.iter().enumerate() {
            let [x, y, z] = found.departure;
            text += &format!(
                "{index},{},{},{},{},{x},{y},{z}\n",
                found.max_base_attitude,
                found.final_base_attitude,
                found.max_base_displacement,
                found.final_base_displacement,
            );
        }
        text
    }
}

fn perturbations<'a>(dispersion: &'a Dispersion, model: &Model) -> Vec<Perturbation<'a>> {
    let all = dispersion.perturbations().iter();
    all.map(|perturbation| Perturbation {
        key: &perturbation.key,
        unit: perturbation.quantity.unit(model),
        nominal: perturbation.quantity.nominal(model),
        distribution: perturbation.distribution.to_string(),
    })
    .collect()
}
