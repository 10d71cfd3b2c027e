//! From smooth to layered: both methods along a sweep of the control's weight.

use super::Measured;
use crate::config::ProblemFile;
use crate::plot::{Axis, Chart, Figure, Marker, Series, Stroke, Width};
use crate::refine::Method::{Adaptive, Global};
use crate::report::{Sheet, exact};
use crate::reproduction::{ReproductionError, Session};
use serde::Serialize;

/// Weights of ∫‖u‖², the smoothest solution first.
const WEIGHTS: [f64; 10] = [1.0, 0.3, 0.1, 0.03, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 0.0];
/// Where zero stands on a logarithmic axis.
const ZERO_AT: f64 = 1e-7;

/// One method at one weight.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SweepRow {
    /// Weight of ∫‖u‖².
    pub control_weight: f64,
    /// What came of it.
    #[serde(flatten)]
    pub measured: Measured,
}

/// Both methods to 1e-5 at every weight, the global one first.
///
/// # Errors
/// Those of [`Session::plan`].
pub fn sweep(session: &mut Session<'_>) -> Result<Vec<SweepRow>, ReproductionError> {
    let smooth = ProblemFile::shipped("table1-smooth")?.problem;
    let mut rows = Vec::new();
    for control_weight in WEIGHTS {
        let problem = smooth.edited(|problem| {
            problem.cost.control.fill(control_weight);
            problem.name = format!("control weight {control_weight}");
        })?;
        for method in [Global, Adaptive] {
            let measured = Measured::of(session, &problem, method, 1)?;
            rows.push(SweepRow {
                control_weight,
                measured,
            });
        }
    }
    Ok(rows)
}

/// The largest weight below which the adaptive method is the better one: the global method needs
/// more points, or does not get there while the adaptive one does. `None` where it never is.
pub fn pays(rows: &[SweepRow]) -> Option<f64> {
    let better = |pair: &&[SweepRow]| {
        let (global, adaptive) = (&pair[0].measured, &pair[1].measured);
        adaptive.reached && (!global.reached || global.points > adaptive.points)
    };
    rows.chunks_exact(2)
        .find(better)
        .map(|pair| pair[0].control_weight)
}

/// The largest weight from which on downwards the adaptive method takes less time or is the only
/// one to get there. `None` where it never does.
pub fn faster(rows: &[SweepRow]) -> Option<f64> {
    let better = |pair: &&[SweepRow]| {
        let (global, adaptive) = (&pair[0].measured, &pair[1].measured);
        adaptive.reached && (!global.reached || adaptive.cpu_seconds < global.cpu_seconds)
    };
    let pairs: Vec<&[SweepRow]> = rows.chunks_exact(2).collect();
    let run = pairs.iter().rev().take_while(|pair| better(pair)).count();
    (run > 0).then(|| pairs[pairs.len() - run][0].control_weight)
}

/// One row a weight, the methods side by side.
pub fn sweep_markdown(rows: &[SweepRow]) -> String {
    let mut sheet = Sheet::new(&[
        "control weight",
        "rpm points",
        "rpm error",
        "rpm CPU / s",
        "a-rpm points",
        "a-rpm error",
        "a-rpm CPU / s",
    ]);
    for pair in rows.chunks_exact(2) {
        let mut cells = vec![match pair[0].control_weight {
            weight if weight > 0.0 && weight < 0.01 => format!("{weight:e}"),
            weight => weight.to_string(),
        }];
        for SweepRow { measured, .. } in pair {
            cells.extend([
                measured.points.to_string(),
                measured.error_cell(),
                format!("{:.3}", measured.cpu_seconds),
            ]);
        }
        sheet.row(cells);
    }
    let verdict = match pays(rows) {
        Some(weight) => format!(
            "From a weight of {weight:e} downwards only the adaptive method gets to 1e-5 with the \
             points it may use, or it needs fewer."
        ),
        None => "The adaptive method needs more points at every weight.".into(),
    };
    let faster = match faster(rows) {
        Some(weight) => format!("In time it pays from a weight of {weight:e} downwards."),
        None => "In time it never pays.".into(),
    };
    format!(
        "Weight of ∫‖u‖² on table1-smooth from 1 (smooth) to 0 (layers at both ends), both \
         methods to 1e-5, the global one\nwith at most 80 points, the adaptive one with at most 6 \
         meshes.\n\n{}\n{verdict} {faster}\n\n",
        sheet.markdown()
    )
}

/// Every figure with all its digits.
pub fn sweep_sheet(rows: &[SweepRow]) -> Sheet {
    let mut header = vec!["control_weight", "method"];
    header.extend(Measured::COLUMNS);
    let mut sheet = Sheet::new(&header);
    for row in rows {
        let mut cells = vec![exact(row.control_weight), row.measured.method.name().into()];
        cells.extend(row.measured.cells());
        sheet.row(cells);
    }
    sheet
}

/// Points and error against the weight.
pub fn sweep_figure(rows: &[SweepRow]) -> Figure {
    let weight = |row: &SweepRow| row.control_weight.max(ZERO_AT);
    let of = |method: crate::refine::Method, value: fn(&Measured) -> f64| {
        let rows = rows.iter().filter(|row| row.measured.method == method);
        rows.map(|row| (weight(row), value(&row.measured)))
            .unzip::<f64, f64, Vec<f64>, Vec<f64>>()
    };
    let chart = |title: &str, y: Axis, value: fn(&Measured) -> f64| {
        let (w, rpm) = of(Global, value);
        let (v, arpm) = of(Adaptive, value);
        let axis = Axis::log("Weight of the control (10⁻⁷ stands for 0)").range(5e-8, 2.0);
        Chart::new(axis, y)
            .title(title)
            .series(Series::line("global RPM", &w, &rpm).marker(Marker::Square))
            .series(
                Series::line("A-RPM", &v, &arpm)
                    .marker(Marker::Disc)
                    .stroke(Stroke::Solid),
            )
    };
    let error = |m: &Measured| m.max_error.unwrap_or(f64::NAN);
    Figure::new(
        "Error reached and points used against the weight of the control",
        Width::Column,
    )
    .panel(
        chart("(a) Error reached", Axis::log("Largest error (28)"), error)
            .bounds("tolerance", &[1e-5]),
    )
    .panel(chart(
        "(b) Points used",
        Axis::linear("Collocation points"),
        |m| m.points as f64,
    ))
}
