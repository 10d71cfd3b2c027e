//! What is written beside the document: data and figures.

use super::Findings;
use crate::reproduction::figures::{self, Drawn};
use crate::reproduction::{ReproductionError, table2};
use crate::solution::to_json;

/// Files by name: tables as CSV, the rest as JSON.
///
/// # Errors
/// [`ReproductionError::Format`]; none is expected.
pub fn data(findings: &Findings) -> Result<Vec<(String, String)>, ReproductionError> {
    let mut files = Vec::new();
    let mut add = |name: &str, text: Result<String, String>| {
        let name = name.to_owned();
        match text {
            Ok(text) => files.push((name, text)),
            Err(message) => return Err(ReproductionError::Format { name, message }),
        }
        Ok(())
    };
    add("table2.csv", Ok(table2::sheet(&findings.rows).csv()))?;
    let sensitivity = table2::sensitivity_sheet(&findings.sensitivity);
    add("sensitivity.csv", Ok(sensitivity.csv()))?;
    add("sweep.csv", Ok(table2::sweep_sheet(&findings.sweep).csv()))?;
    let json = to_json(&findings.bounds).map_err(|e| e.to_string());
    add("bounds.json", json)?;
    for compared in &findings.compared {
        let csv = compared.report().csv().map_err(|e| e.to_string());
        add(&format!("compare-{}.csv", compared.problem.name), csv)?;
    }
    let csv = findings.trade_off.report().csv();
    add("pareto.csv", csv.map_err(|e| e.to_string()))?;
    let json = to_json(&findings.platform.record()).map_err(|e| e.to_string());
    add("platform.json", json)?;
    for fit in &findings.platform.fits {
        let json = fit.json().map_err(|e| e.to_string());
        add(&format!("fit-{}.json", fit.name), json)?;
    }
    Ok(files)
}

/// All figures of the document.
pub fn pictures(findings: &Findings) -> Vec<Drawn> {
    let mut drawn = figures::all(&findings.plans, &findings.bounded);
    drawn.push(sweep(findings));
    drawn.extend(findings.compared.iter().map(|compared| compared.drawn()));
    drawn.push(findings.trade_off.drawn());
    drawn
}

/// Both methods along the sweep of the control's weight.
pub(super) fn sweep(findings: &Findings) -> Drawn {
    Drawn {
        name: "sweep".into(),
        caption: "Sweep of the control's weight: error reached and points used.".into(),
        figure: table2::sweep_figure(&findings.sweep),
    }
}
