//! How much the unpublished constants λ₁, λ₂ and r_max of the law (30), (32) matter.

use super::Measured;
use crate::config::ProblemFile;
use crate::refine::Method;
use crate::report::{Sheet, exact};
use crate::reproduction::{CASES, ReproductionError, Session};
use serde::Serialize;

const LAMBDA1: [f64; 3] = [1.0, 2.0, 4.0];
const LAMBDA2: [f64; 3] = [1.0, 3.0, 5.0];
const R_MAX: [f64; 4] = [1.0, 1.5, 2.0, 4.0];

/// A-RPM with one set of constants.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SensitivityRow {
    /// The shipped problem.
    pub problem: &'static str,
    /// λ₁ of (30).
    pub lambda1: f64,
    /// λ₂ of (32).
    pub lambda2: f64,
    /// Curvature ratio above which a segment is divided.
    pub r_max: f64,
    /// What came of it.
    #[serde(flatten)]
    pub measured: Measured,
}

/// A-RPM over a grid of constants on both cases, to the tolerance of their files.
///
/// # Errors
/// Those of [`Session::plan`].
pub fn sensitivity(session: &mut Session<'_>) -> Result<Vec<SensitivityRow>, ReproductionError> {
    let mut rows = Vec::new();
    for (name, _) in CASES {
        let case = ProblemFile::shipped(name)?.problem;
        for lambda1 in LAMBDA1 {
            for lambda2 in LAMBDA2 {
                for r_max in R_MAX {
                    let problem = case.edited(|problem| {
                        let mesh = &mut problem.mesh;
                        (mesh.lambda1, mesh.lambda2, mesh.r_max) = (lambda1, lambda2, r_max);
                    })?;
                    rows.push(SensitivityRow {
                        problem: name,
                        lambda1,
                        lambda2,
                        r_max,
                        measured: Measured::of(session, &problem, Method::Adaptive, 1)?,
                    });
                }
            }
        }
    }
    Ok(rows)
}

/// One table a problem: points and meshes for every set of constants.
pub fn sensitivity_markdown(rows: &[SensitivityRow]) -> String {
    let mut text = String::from(
        "Sensitivity to the constants of the law: points on the last mesh in meshes solved, to \
         1e-5; where that was\nnot reached in 6 meshes, the error that was.\n",
    );
    for problem in rows.chunk_by(|a, b| a.problem == b.problem) {
        let mut header = vec!["λ₁".to_string(), "λ₂".to_string()];
        header.extend(R_MAX.iter().map(|r| format!("r_max = {r}")));
        let mut sheet = Sheet::new(&header);
        let same = |a: &SensitivityRow, b: &SensitivityRow| {
            a.lambda1 == b.lambda1 && a.lambda2 == b.lambda2
        };
        for line in problem.chunk_by(same) {
            let mut cells = vec![line[0].lambda1.to_string(), line[0].lambda2.to_string()];
            cells.extend(line.iter().map(|row| {
                let Measured { points, solves, .. } = row.measured;
                if row.measured.reached {
                    format!("{points} in {solves}")
                } else {
                    format!("{points} in {solves}: {}", row.measured.error_cell())
                        .replace(", not reached", "")
                }
            }));
            sheet.row(cells);
        }
        text.push_str(&format!(
            "\n`{}`\n\n{}",
            problem[0].problem,
            sheet.markdown()
        ));
    }
    text.push('\n');
    text
}

/// Every figure with all its digits.
pub fn sensitivity_sheet(rows: &[SensitivityRow]) -> Sheet {
    let mut header = vec!["problem", "lambda1", "lambda2", "r_max"];
    header.extend(Measured::COLUMNS);
    let mut sheet = Sheet::new(&header);
    for row in rows {
        let mut cells = vec![row.problem.into()];
        cells.extend([row.lambda1, row.lambda2, row.r_max].map(exact));
        cells.extend(row.measured.cells());
        sheet.row(cells);
    }
    sheet
}
