//! Table II beside the published figures.

use super::Measured;
use crate::config::ProblemFile;
use crate::nlp::ipopt;
use crate::refine::ErrorMeasure;
use crate::refine::Method::{Adaptive, Global};
use crate::report::{Sheet, exact, short};
use crate::reproduction::{CASES, ReproductionError, Session};
use crate::solution::Build;
use serde::Serialize;

/// Figures of Table II.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Published {
    /// LGR points.
    pub points: usize,
    /// CPU time, s.
    pub seconds: f64,
    /// Largest error (28).
    pub max_error: f64,
}

/// Tolerance, global RPM, A-RPM.
const PUBLISHED: [(f64, Published, Published); 3] = [
    (
        1e-3,
        published(35, 6.9184, 44.523e-5),
        published(50, 6.2382, 50.848e-5),
    ),
    (
        1e-4,
        published(40, 16.2167, 5.3082e-5),
        published(56, 6.4106, 7.7247e-5),
    ),
    (
        1e-5,
        published(57, 36.5233, 0.6078e-5),
        published(67, 7.6697, 0.9436e-5),
    ),
];

const fn published(points: usize, seconds: f64, max_error: f64) -> Published {
    Published {
        points,
        seconds,
        max_error,
    }
}

/// One method to one tolerance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// The shipped problem.
    pub problem: &'static str,
    /// Tolerance on the error (28).
    pub tolerance: f64,
    /// Ours.
    #[serde(flatten)]
    pub measured: Measured,
    /// Cost J* of the optimum.
    pub optimum: f64,
    /// |J − J*|.
    pub distance: Option<f64>,
    /// The paper's.
    pub published: Published,
}

/// Both methods at the three tolerances on both cases, in the paper's order.
///
/// # Errors
/// Those of [`Session::plan`].
pub fn rows(session: &mut Session<'_>, repeat: u16) -> Result<Vec<Row>, ReproductionError> {
    let mut rows = Vec::new();
    for (name, optimum) in CASES {
        let case = ProblemFile::shipped(name)?.problem;
        for (tolerance, global, adaptive) in PUBLISHED {
            let problem = case.edited(|problem| {
                problem.mesh.tolerance = tolerance;
                problem.mesh.error = ErrorMeasure::Paper;
            })?;
            for (method, published) in [(Global, global), (Adaptive, adaptive)] {
                let measured = Measured::of(session, &problem, method, repeat)?;
                rows.push(Row {
                    problem: name,
                    tolerance,
                    distance: measured.objective.map(|cost| (cost - optimum).abs()),
                    measured,
                    optimum,
                    published,
                });
            }
        }
    }
    Ok(rows)
}

/// One table a problem, with what was measured how.
pub fn markdown(rows: &[Row], repeat: u16) -> String {
    let mut text = format!(
        "Table II: global RPM against A-RPM, beside the published figures.\n\n\
         CPU time is the processor's from the start of planning, median of {repeat}; error is the \
         largest of (28),\nquadrature the largest relative error of the states by quadrature on a \
         finer LGR set, J* the known optimum.\nThe published case itself has no solution (see \
         `config/table1.toml`), so that only the trend can be\ncompared. ffsm-ipopt {}, Ipopt {}.\n",
        Build::VERSION,
        ipopt::version()
    );
    for group in rows.chunk_by(|a, b| a.problem == b.problem) {
        text.push_str(&format!(
            "\n`{}`, J* = {}\n\n{}",
            group[0].problem,
            group[0].optimum,
            table(group).markdown()
        ));
    }
    text.push('\n');
    text
}

fn table(rows: &[Row]) -> Sheet {
    let mut sheet = Sheet::new(&[
        "tolerance",
        "method",
        "points",
        "solves",
        "NLP iterations",
        "CPU / s",
        "error",
        "quadrature",
        "J − J*",
        "published points",
        "published CPU / s",
        "published error",
    ]);
    for row in rows {
        let Row {
            measured,
            published,
            ..
        } = row;
        sheet.row(vec![
            format!("{:e}", row.tolerance),
            measured.method.name().into(),
            measured.points.to_string(),
            measured.solves.to_string(),
            measured.nlp_iterations.to_string(),
            format!("{:.3}", measured.cpu_seconds),
            measured.error_cell(),
            short(measured.quadrature_error.unwrap_or(f64::NAN)),
            short(row.distance.unwrap_or(f64::NAN)),
            published.points.to_string(),
            format!("{:.2}", published.seconds),
            short(published.max_error),
        ]);
    }
    sheet
}

/// Every figure with all its digits.
pub fn sheet(rows: &[Row]) -> Sheet {
    let published = [
        "published_points",
        "published_seconds",
        "published_max_error",
    ];
    let mut header = vec!["problem", "tolerance", "method"];
    header.extend(Measured::COLUMNS);
    header.extend(["optimum", "distance"].into_iter().chain(published));
    let mut sheet = Sheet::new(&header);
    for row in rows {
        let published = &row.published;
        let mut cells = vec![
            row.problem.into(),
            exact(row.tolerance),
            row.measured.method.name().into(),
        ];
        cells.extend(row.measured.cells());
        cells.extend([
            exact(row.optimum),
            exact(row.distance.unwrap_or(f64::NAN)),
            published.points.to_string(),
            exact(published.seconds),
            exact(published.max_error),
        ]);
        sheet.row(cells);
    }
    sheet
}
