//! What `simulate --fit` leaves behind: `fit.md`, which is also printed, and `fit.json`.

use super::{Build, to_json};
use crate::simulate::fit::{Comparison, Fit, Fitted, Scale};
use comfy_table::{CellAlignment, Table, presets};
use serde::Serialize;
use std::path::PathBuf;

/// Hypotheses about a platform, each fitted to the same measurements.
#[derive(Debug, Clone)]
pub struct FitReport<'a> {
    /// Name of the fit.
    pub name: &'a str,
    /// Path and text of its file.
    pub file: (&'a str, &'a str),
    /// What each experiment played, in words.
    pub plans: &'a [(String, String)],
    /// Differences that count one.
    pub scale: Scale,
    /// The platform as it stands in its file.
    pub unfitted: &'a [Comparison],
    /// Its residual.
    pub unfitted_residual: f64,
    /// Hypotheses by name.
    pub fits: &'a [(String, Fit)],
}

impl FitReport<'_> {
    /// Tables and findings in Markdown.
    pub fn markdown(&self) -> String {
        let mut text = format!(
            "Platform parameters by least squares: {}\n\n\
             Residuals are root mean squares in units of {} and {}; signs are not published, so \
             that magnitudes\nare compared.\n\n",
            self.name,
            shown(true, self.scale.attitude),
            shown(false, self.scale.length)
        );
        for (experiment, plan) in self.plans {
            text.push_str(&format!("- {experiment}: {plan}\n"));
        }
        text.push_str(&format!("\n{}\n", self.table()));
        for (name, fit) in self.fits {
            let [starts, near] = fit.starts;
            text.push_str(&format!(
                "\n{name}: residual {:.2}, {near} of {starts} starts end there\n\n{}\n",
                fit.residual,
                parameters(&fit.parameters)
            ));
        }
        text.push_str(&format!("\n{}\n", self.findings()));
        text
    }

    /// One row a hypothesis, one column a measurement.
    fn table(&self) -> Table {
        let mut table = Table::new();
        let columns = self
            .unfitted
            .iter()
            .map(|c| format!("{} {}", c.experiment, c.what));
        let header = ["", "free", "residual"].map(String::from);
        table
            .load_style(presets::ASCII_MARKDOWN)
            .set_header(header.into_iter().chain(columns));
        let measured = self.unfitted.iter().map(|c| shown(c.angle, c.measured));
        let row = ["measured", "", ""].map(String::from);
        table.add_row(row.into_iter().chain(measured));
        let mut add = |name: &str, free: usize, residual: f64, found: &[Comparison]| {
            let row = [name.into(), free.to_string(), format!("{residual:.2}")];
            let simulated = found.iter().map(|c| shown(c.angle, c.simulated));
            table.add_row(row.into_iter().chain(simulated));
        };
        add("as it is", 0, self.unfitted_residual, self.unfitted);
        for (name, fit) in self.fits {
            add(name, fit.parameters.len(), fit.residual, &fit.comparisons);
        }
        align(&mut table);
        table
    }

    /// What the best hypothesis leaves unexplained, and which measurements none reaches.
    fn findings(&self) -> String {
        let Some((name, best)) = self
            .fits
            .iter()
            .min_by(|a, b| a.1.residual.total_cmp(&b.1.residual))
        else {
            return String::new();
        };
        let data = best.comparisons.len();
        let mut text = format!(
            "Best: {name}, residual {:.2} with {} numbers free for {data} measured.",
            best.residual,
            best.parameters.len()
        );
        let unit = |c: &Comparison| {
            if c.angle {
                self.scale.attitude
            } else {
                self.scale.length
            }
        };
        let gap = |c: &Comparison| (c.simulated.abs() - c.measured) / unit(c);
        let left: Vec<String> = best
            .comparisons
            .iter()
            .filter(|c| gap(c).abs() > 0.5)
            .map(|c| {
                format!(
                    "{} {}: measured {}, simulated {}",
                    c.experiment,
                    c.what,
                    shown(c.angle, c.measured),
                    shown(c.angle, c.simulated)
                )
            })
            .collect();
        if left.is_empty() {
            text.push_str(&format!(
                " It meets every measurement within {} and {}.",
                shown(true, 0.5 * self.scale.attitude),
                shown(false, 0.5 * self.scale.length)
            ));
        } else {
            text.push_str(" It leaves unexplained:\n\n");
            for line in left {
                text.push_str(&format!("- {line}\n"));
            }
        }
        let bounded: Vec<&str> = best
            .parameters
            .iter()
            .filter(|p| p.at_bound)
            .map(|p| p.parameter.key)
            .collect();
        if !bounded.is_empty() {
            let list = bounded.join(", ");
            text.push_str(&format!(
                "\nAt the end of the range thought possible: {list}.\n"
            ));
        }
        let loose: Vec<&str> = best
            .parameters
            .iter()
            .filter(|p| !p.at_bound && p.error.is_none())
            .map(|p| p.parameter.key)
            .collect();
        if !loose.is_empty() {
            let list = loose.join(", ");
            text.push_str(&format!("\nNot determined by the measurements: {list}.\n"));
        }
        text.trim_end().into()
    }

    /// `fit.json`.
    ///
    /// # Errors
    /// None that is expected: all keys are strings.
    pub fn json(&self) -> serde_json::Result<String> {
        let (path, text) = self.file;
        to_json(&Document {
            schema: 1,
            name: self.name,
            version: Build::VERSION,
            path,
            text,
            plans: self.plans.iter().map(|(e, p)| [e.as_str(), p]).collect(),
            unit_attitude: self.scale.attitude,
            unit_length: self.scale.length,
            unfitted: Unfitted {
                residual: self.unfitted_residual,
                comparisons: comparisons(self.unfitted),
            },
            hypotheses: self
                .fits
                .iter()
                .map(|(name, fit)| HypothesisRecord {
                    name,
                    residual: fit.residual,
                    starts: fit.starts[0],
                    starts_that_end_there: fit.starts[1],
                    simulations: fit.simulations,
                    parameters: fit.parameters.iter().map(fitted).collect(),
                    comparisons: comparisons(&fit.comparisons),
                })
                .collect(),
        })
    }

    /// The text for a terminal, with the files that were written.
    pub fn summary(&self, files: &[PathBuf]) -> String {
        let mut text = self.markdown();
        for file in files {
            text.push_str(&format!("\nwritten {}", file.display()));
        }
        text.push('\n');
        text
    }
}

fn parameters(fitted: &[Fitted]) -> Table {
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN).set_header([
        "parameter",
        "value",
        "±",
        "unit",
        "range",
    ]);
    for f in fitted {
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
        table.add_row([
            key,
            format!("{:.3e}", f.value),
            error,
            f.parameter.unit.into(),
            format!("{min:e} to {max:e}"),
        ]);
    }
    align(&mut table);
    table
}

fn align(table: &mut Table) {
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
}

/// An angle in degrees or a length in centimetres, as the paper gives them.
fn shown(angle: bool, value: f64) -> String {
    if angle {
        format!("{:.1}°", value.to_degrees())
    } else {
        format!("{:.1} cm", 100.0 * value)
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
        what: found.what,
        unit: if found.angle { "rad" } else { "m" },
        measured: found.measured,
        simulated: found.simulated,
    }
}
