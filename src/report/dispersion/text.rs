//! The lines a person reads of a dispersion.

use super::DispersionReport;
use super::figure::DispersedFigure;
use crate::report::format::gap;
use crate::report::{Lines, Sheet};
use crate::study::dispersion::{Response, Sensitivities};
use crate::text::digits::digits;
use std::path::PathBuf;

/// Quantities listed for each response.
const LISTED: usize = 8;
/// Share below which a quantity is not listed.
const LEAST: f64 = 0.005;
/// Part of the variance that a linear model has to explain for its shares to be taken at face value.
const LINEAR: f64 = 0.9;

impl DispersionReport<'_> {
    /// Figures beside the plan's, which quantities they come from, files.
    pub fn summary(&self, files: &[PathBuf]) -> String {
        let name = &self.problem.name;
        let mut text = format!("{name}: {}\n\n{}", self.heading(), self.sheet().markdown());
        for found in &self.sensitivities {
            if matches!(
                found.response,
                Response::Departure | Response::LargestAttitude
            ) {
                text += &format!("\n{}\n\n{}", headline(found), shares(found).markdown());
            }
        }
        if let Some(why) = self.without_sensitivities() {
            text += &format!("\n{why}\n");
        }
        let mut lines = Lines::default();
        lines.add("replay", self.steps());
        lines.files(files);
        format!("{text}\n{}", lines.finish())
    }

    /// How many samples of what.
    pub(in crate::report) fn heading(&self) -> String {
        let all = self.dispersion.perturbations().iter();
        let varied = all.filter(|perturbation| !perturbation.distribution.is_fixed());
        format!(
            "{} replays, {} quantities perturbed, seed {}",
            self.samples.len(),
            varied.count(),
            self.seed
        )
    }

    /// How exact the replays are.
    pub(in crate::report) fn steps(&self) -> String {
        let [steps, evaluations] = self.replays.steps();
        let [attitude, position] = self.replays.drift();
        format!(
            "{steps} Gauss-Legendre steps, {evaluations} momentum evaluations a sample, exact to \
             {} rad and m; the plan's own collocation error, taken off, is {} rad and {} m",
            gap(self.replays.step_error()),
            gap(attitude),
            gap(position)
        )
    }

    /// Why nothing is said of sensitivities, where that is so.
    pub(in crate::report) fn without_sensitivities(&self) -> Option<String> {
        if !self.sensitivities.is_empty() {
            return None;
        }
        if self.dispersion.is_fixed() {
            return Some("Nothing varies, so that nothing is to be explained.".into());
        }
        let needed = Sensitivities::needed(self.replays);
        (self.samples.len() < needed).then(|| {
            format!("What the spread comes from is not said of fewer than {needed} samples.")
        })
    }

    fn sheet(&self) -> Sheet {
        let header = [
            "", "plan", "mean", "sd", "50 %", "90 %", "95 %", "99 %", "worst", "sample",
        ];
        let mut sheet = Sheet::new(&header).words(1);
        for figure in &self.figures {
            sheet.row(row(figure));
        }
        sheet
    }
}

/// A figure as a row of the table.
pub(in crate::report) fn row(figure: &DispersedFigure) -> Vec<String> {
    let spread = &figure.spread;
    let shown = |value: f64| digits(figure.measure.factor() * value, 3, 3);
    let label = format!("{}, {}", figure.title, figure.measure.unit());
    let values = [figure.planned, spread.mean, spread.sd];
    // The quantile at 5 % is for files.
    let quantiles = spread.quantiles.iter().skip(1).map(|[_, value]| *value);
    std::iter::once(label)
        .chain(values.into_iter().chain(quantiles).map(shown))
        .chain([spread.worst.to_string()])
        .collect()
}

/// What is explained, and how well.
pub(in crate::report) fn headline(found: &Sensitivities) -> String {
    let what = match found.response {
        Response::Departure => "the final attitude off the plan",
        Response::LargestAttitude => "the largest base angle",
        Response::FinalAttitude => "the final base angle",
        Response::LargestDisplacement => "the largest base displacement",
        _ => "the final base displacement",
    };
    let part = 100.0 * found.explained;
    let caution = match found.explained < LINEAR {
        true => "; the rest is curvature and quantities acting together, which shares leave out",
        false => "",
    };
    format!(
        "What {what} comes from, shares of its variance; a linear model explains {part:.1} % \
         (adjusted R²){caution}:"
    )
}

/// The quantities that matter most.
fn shares(found: &Sensitivities) -> Sheet {
    let factor = match found.response {
        Response::LargestDisplacement | Response::FinalDisplacement => 100.0,
        _ => 1f64.to_degrees(),
    };
    let unit = match factor {
        100.0 => "alone, sd cm",
        _ => "alone, sd °",
    };
    let mut sheet = Sheet::new(&["quantity", "share", unit]).words(1);
    let listed = found.shares.iter().filter(|share| share.share >= LEAST);
    for share in listed.take(LISTED) {
        let part = format!("{:.1} %", 100.0 * share.share);
        sheet.row(vec![
            share.key.clone(),
            part,
            digits(factor * share.sd, 4, 2),
        ]);
    }
    sheet
}
