//! What `simulate --fit` leaves behind: `fit.md`, which is also printed, and `fit.json`.

use super::Sheet;
use crate::simulate::fit::{Comparison, Fit, Fitted, Scale};
use crate::solution::{Build, to_json};
use crate::text::digits::digits;
use serde::Serialize;

/// Hypotheses about a platform, each fitted to the same measurements.
#[derive(Debug, Clone)]
pub struct FitReport {
    /// Name of the fit.
    pub name: String,
    /// Path and text of its file.
    pub file: (String, String),
    /// What each experiment played, in words.
    pub plans: Vec<(String, String)>,
    /// Differences that count one.
    pub scale: Scale,
    /// The platform as it stands in its file.
    pub unfitted: Vec<Comparison>,
    /// Its residual.
    pub unfitted_residual: f64,
    /// Hypotheses by name.
    pub fits: Vec<(String, Fit)>,
}

impl FitReport {
    /// Tables and findings in Markdown.
    pub fn markdown(&self) -> String {
        let mut text = format!(
            "Platform parameters by least squares: {}\n\n\
             Residuals are root mean squares in units of {} and {}; signs are not published, so \
             that magnitudes\nare compared. Reduced: divided by the numbers measured less those free \
             instead of all. ✓: within one\nunit of what was measured.\n\n",
            self.name,
            shown(true, self.scale.attitude),
            shown(false, self.scale.length)
        );
        for (experiment, plan) in &self.plans {
            text.push_str(&format!("- {experiment}: {plan}\n"));
        }
        text.push_str(&format!(
            "\n{}\n{}\n{}\n",
            self.simulated().markdown(),
            self.parameters().markdown(),
            self.findings()
        ));
        text
    }

    /// The hypothesis with the smallest reduced residual, which numbers that are free are counted
    /// against.
    pub fn best(&self) -> Option<&(String, Fit)> {
        let fits = self.fits.iter();
        fits.min_by(|a, b| reduced(&a.1).total_cmp(&reduced(&b.1)))
    }

    /// The same among those with one platform for all experiments.
    pub fn best_common(&self) -> Option<&(String, Fit)> {
        let common = |(_, fit): &&(String, Fit)| {
            let mut parameters = fit.parameters.iter();
            parameters.all(|fitted| fitted.experiment.is_none())
        };
        let fits = self.fits.iter().filter(common);
        fits.min_by(|a, b| reduced(&a.1).total_cmp(&reduced(&b.1)))
    }

    /// Difference of the magnitudes, in units of the scale.
    fn gap(&self, comparison: &Comparison) -> f64 {
        let unit = if comparison.what.is_angle() {
            self.scale.attitude
        } else {
            self.scale.length
        };
        (comparison.simulated.abs() - comparison.measured) / unit
    }

    /// One row a hypothesis, one column a measurement.
    fn simulated(&self) -> Sheet {
        let mut header = ["", "free", "residual", "reduced", "starts that end there"]
            .map(String::from)
            .to_vec();
        let columns = self.unfitted.iter();
        header.extend(columns.map(|c| format!("{} {}", c.experiment, c.what)));
        let mut sheet = Sheet::new(&header).words(1);
        let mut add = |start: [String; 5], figures: Vec<String>| {
            sheet.row(start.into_iter().chain(figures).collect());
        };
        let cells = |found: &[Comparison]| -> Vec<String> {
            let cell = |c: &Comparison| {
                let mark = if self.gap(c).abs() <= 1.0 { " ✓" } else { "" };
                format!("{}{mark}", shown(c.what.is_angle(), c.simulated))
            };
            found.iter().map(cell).collect()
        };
        let measured = self
            .unfitted
            .iter()
            .map(|c| shown(c.what.is_angle(), c.measured));
        let start = ["measured", "", "", "", ""].map(String::from);
        add(start, measured.collect());
        let residual = digits(self.unfitted_residual, 2, 2);
        let start = [
            "as it is".into(),
            "0".into(),
            residual.clone(),
            residual,
            String::new(),
        ];
        add(start, cells(&self.unfitted));
        for (name, fit) in &self.fits {
            let [starts, near] = fit.starts;
            let start = [
                name.clone(),
                fit.parameters.len().to_string(),
                digits(fit.residual, 2, 2),
                digits(reduced(fit), 2, 2),
                format!("{near} of {starts}"),
            ];
            add(start, cells(&fit.comparisons));
        }
        sheet
    }

    /// One row a fitted number.
    fn parameters(&self) -> Sheet {
        let mut sheet =
            Sheet::new(&["hypothesis", "parameter", "value", "±", "unit", "range"]).words(2);
        for (name, fit) in &self.fits {
            for f in &fit.parameters {
                let key = match &f.experiment {
                    Some(experiment) => format!("{} ({experiment})", f.parameter.key),
                    None => f.parameter.key.into(),
                };
                let error = match f.error {
                    _ if f.at_bound => "at its bound".into(),
                    Some(error) => format!("{error:.1e}"),
                    None => "not determined".into(),
                };
                let [min, max] = f.range;
                sheet.row(vec![
                    name.clone(),
                    key,
                    format!("{:.3e}", f.value),
                    error,
                    f.parameter.unit.into(),
                    format!("{min:e} to {max:e}"),
                ]);
            }
        }
        sheet
    }

    /// What the best hypothesis leaves unexplained, and which measurements none reaches.
    fn findings(&self) -> String {
        let Some((name, best)) = self.best() else {
            return String::new();
        };
        let data = best.comparisons.len();
        let mut text = format!(
            "Best: {name}, reduced residual {:.2} with {} numbers free for {data} measured.",
            reduced(best),
            best.parameters.len()
        );
        let left: Vec<String> = best
            .comparisons
            .iter()
            .filter(|c| self.gap(c).abs() > 1.0)
            .map(|c| {
                format!(
                    "- {} {}: measured {}, simulated {}\n",
                    c.experiment,
                    c.what,
                    shown(c.what.is_angle(), c.measured),
                    shown(c.what.is_angle(), c.simulated)
                )
            })
            .collect();
        if left.is_empty() {
            text.push_str(" It meets every measurement within one unit.\n");
        } else {
            text.push_str(&format!(" It leaves unexplained:\n\n{}", left.concat()));
        }
        let missed: Vec<String> = (self.unfitted.iter().enumerate())
            .filter(|(k, _)| {
                let reaches =
                    |(_, fit): &(String, Fit)| self.gap(&fit.comparisons[*k]).abs() <= 1.0;
                !self.fits.iter().any(reaches)
            })
            .map(|(_, c)| format!("{} {}", c.experiment, c.what))
            .collect();
        let missed = match missed.is_empty() {
            true => "none".into(),
            false => missed.join(", "),
        };
        text.push_str(&format!(
            "\nMeasurements that no hypothesis reaches within one unit: {missed}.\n"
        ));
        let named = |chosen: &dyn Fn(&Fitted) -> bool| -> Vec<&str> {
            let chosen = best.parameters.iter().filter(|f| chosen(f));
            chosen.map(|f| f.parameter.key).collect()
        };
        let bounded = named(&|f| f.at_bound);
        if !bounded.is_empty() {
            text.push_str(&format!(
                "\nOf the best, at the end of the range thought possible: {}.\n",
                bounded.join(", ")
            ));
        }
        let loose = named(&|f| !f.at_bound && f.error.is_none());
        if !loose.is_empty() {
            text.push_str(&format!(
                "\nOf the best, not determined by the measurements: {}.\n",
                loose.join(", ")
            ));
        }
        text.trim_end().into()
    }

    /// `fit.json`.
    ///
    /// # Errors
    /// None that is expected: all keys are strings.
    pub fn json(&self) -> serde_json::Result<String> {
        let (path, text) = &self.file;
        to_json(&Document {
            schema: 1,
            name: &self.name,
            version: Build::VERSION,
            path,
            text,
            plans: self.plans.iter().map(|(e, p)| [e.as_str(), p]).collect(),
            unit_attitude: self.scale.attitude,
            unit_length: self.scale.length,
            unfitted: Unfitted {
                residual: self.unfitted_residual,
                comparisons: comparisons(&self.unfitted),
            },
            hypotheses: self
                .fits
                .iter()
                .map(|(name, fit)| HypothesisRecord {
                    name,
                    residual: fit.residual,
                    reduced_residual: reduced(fit),
                    starts: fit.starts[0],
                    starts_that_end_there: fit.starts[1],
                    simulations: fit.simulations,
                    parameters: fit.parameters.iter().map(fitted).collect(),
                    comparisons: comparisons(&fit.comparisons),
                })
                .collect(),
        })
    }
}

/// The residual, its squares divided by the numbers measured less those free instead of all.
pub fn reduced(fit: &Fit) -> f64 {
    let count = fit.comparisons.len();
    let left = count.saturating_sub(fit.parameters.len()).max(1);
    fit.residual * (count as f64 / left as f64).sqrt()
}

/// An angle in degrees or a length in centimetres, as the paper gives them.
fn shown(angle: bool, value: f64) -> String {
    if angle {
        format!("{}°", digits(value.to_degrees(), 1, 1))
    } else {
        format!("{} cm", digits(100.0 * value, 1, 1))
    }
}

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    name: &'a str,
    version: &'static str,
    path: &'a str,
    text: &'a str,
    plans: Vec<[&'a str; 2]>,
    unit_attitude: f64,
    unit_length: f64,
    unfitted: Unfitted<'a>,
    hypotheses: Vec<HypothesisRecord<'a>>,
}

#[derive(Serialize)]
struct Unfitted<'a> {
    residual: f64,
    comparisons: Vec<ComparisonRecord<'a>>,
}

#[derive(Serialize)]
struct HypothesisRecord<'a> {
    name: &'a str,
    residual: f64,
    reduced_residual: f64,
    starts: usize,
    starts_that_end_there: usize,
    simulations: usize,
    parameters: Vec<ParameterRecord<'a>>,
    comparisons: Vec<ComparisonRecord<'a>>,
}

#[derive(Serialize)]
struct ParameterRecord<'a> {
    key: &'a str,
    experiment: Option<&'a str>,
    unit: &'a str,
    value: f64,
    standard_error: Option<f64>,
    at_bound: bool,
    range: [f64; 2],
}

#[derive(Serialize)]
struct ComparisonRecord<'a> {
    experiment: &'a str,
    what: &'a str,
    unit: &'a str,
    measured: f64,
    simulated: f64,
}

fn fitted(found: &Fitted) -> ParameterRecord<'_> {
    ParameterRecord {
        key: found.parameter.key,
        experiment: found.experiment.as_deref(),
        unit: found.parameter.unit,
        value: found.value,
        standard_error: found.error,
        at_bound: found.at_bound,
        range: found.range,
    }
}

fn comparisons(found: &[Comparison]) -> Vec<ComparisonRecord<'_>> {
    found.iter().map(comparison).collect()
}

fn comparison(found: &Comparison) -> ComparisonRecord<'_> {
    ComparisonRecord {
        experiment: &found.experiment,
        what: found.what.name(),
        unit: if found.what.is_angle() { "rad" } else { "m" },
        measured: found.measured,
        simulated: found.simulated,
    }
}
