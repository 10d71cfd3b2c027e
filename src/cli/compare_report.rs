//! The comparison as Markdown, CSV and JSON.

use super::compare::Entry;
use super::failure::Failure;
use crate::nlp::ipopt;
use crate::planner::{JointEffort, Status};
use crate::report::{Build, to_json};
use comfy_table::{CellAlignment, Table, presets};
use serde::Serialize;

/// One planner; SI units and radians, null where there is no plan.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Row {
    method: &'static str,
    description: &'static str,
    /// As in `solution.json`, or "not_for_this_task".
    status: &'static str,
    /// Why it is not solved.
    reason: Option<String>,
    max_base_attitude: Option<f64>,
    final_base_attitude: Option<f64>,
    max_base_displacement: Option<f64>,
    final_base_displacement: Option<f64>,
    base_rate_integral: Option<f64>,
    control_integral: Option<f64>,
    torque_integral: Option<f64>,
    peak_joint_velocity: Option<f64>,
    peak_joint_torque: Option<f64>,
    /// J of the problem, whatever the planner's own cost.
    objective: Option<f64>,
    /// Wall time, s.
    seconds: Option<f64>,
}

impl Row {
    /// The row of one planner.
    pub(super) fn of(entry: &Entry) -> Self {
        let (plan, refused) = match &entry.plan {
            Ok(plan) => (Some(plan), None),
            Err(reason) => (None, Some(reason.clone())),
        };
        let effort = plan.map(|p| JointEffort::of(&p.trajectory, &p.discretization.mesh));
        let metric = |value: fn(&crate::planner::Metrics) -> f64| plan.map(|p| value(&p.metrics));
        let reason = plan.and_then(|plan| match (&plan.diagnosis, plan.status) {
            (Some(diagnosis), _) => Some(diagnosis.summary.clone()),
            (None, Status::NotConverged) => Some(match plan.iterations.last() {
                Some(last) if !last.nlp_status.is_solved() => last.nlp_status.describe().into(),
                _ => format!(
                    "the tolerance {:e} is not reached, the largest error is {:.1e}",
                    plan.tolerance, plan.max_error
                ),
            }),
            _ => None,
        });
        Self {
            method: entry.method.name(),
            description: entry.method.describe(),
            status: plan.map_or("not_for_this_task", |plan| plan.status.name()),
            reason: refused.or(reason),
            max_base_attitude: metric(|m| m.max_base_attitude),
            final_base_attitude: metric(|m| m.final_base_attitude),
            max_base_displacement: metric(|m| m.max_base_displacement),
            final_base_displacement: metric(|m| m.final_base_displacement),
            base_rate_integral: effort.map(|e| e.base_rate),
            control_integral: effort.map(|e| e.control),
            torque_integral: effort.map(|e| e.torque),
            peak_joint_velocity: metric(|m| m.peak_joint_velocity),
            peak_joint_torque: metric(|m| m.peak_joint_torque),
            objective: plan.map(|p| p.objective).filter(|j| j.is_finite()),
            seconds: plan.map(|p| p.timing.total.as_secs_f64()),
        }
    }
}

/// One table, then why planners have no solution.
pub(super) fn markdown(name: &str, rows: &[Row], notes: &[String]) -> String {
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN).set_header([
        "planner",
        "status",
        "base attitude max / °",
        "end / °",
        "displacement max / cm",
        "end / cm",
        "∫‖u‖²",
        "∫‖τ‖²",
        "joint rate max / °/s",
        "torque max / N·m",
        "J",
        "time / s",
    ]);
    let shown = |value: Option<f64>, factor: f64, decimals: usize| {
        value.map_or_else(|| "–".into(), |v| format!("{:.decimals$}", v * factor))
    };
    let digits = |value: Option<f64>| value.map_or_else(|| "–".into(), |v| format!("{v:.3e}"));
    let degrees = 1f64.to_degrees();
    for row in rows {
        table.add_row([
            row.method.into(),
            row.status.replace('_', " "),
            shown(row.max_base_attitude, degrees, 3),
            shown(row.final_base_attitude, degrees, 3),
            shown(row.max_base_displacement, 100.0, 3),
            shown(row.final_base_displacement, 100.0, 3),
            digits(row.control_integral),
            digits(row.torque_integral),
            shown(row.peak_joint_velocity, degrees, 3),
            shown(row.peak_joint_torque, 1.0, 4),
            shown(row.objective, 1.0, 6),
            shown(row.seconds, 1.0, 3),
        ]);
    }
    for column in table.column_iter_mut().skip(2) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let mut text = format!("`{name}` by every planner.\n\n{table}\n\n");
    for row in rows {
        if let Some(reason) = &row.reason {
            text.push_str(&format!("- {}: {reason}\n", row.method));
        }
    }
    for note in notes {
        text.push_str(&format!("- {note}\n"));
    }
    text.push_str(&format!(
        "\nAngles are the largest of any base angle. Sliding joints count in m and N. J is the \
         problem's cost, whatever a planner's own.\nffsm-ipopt {}, Ipopt {}.\n",
        Build::VERSION,
        ipopt::version()
    ));
    text
}

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    version: &'static str,
    ipopt: &'static str,
    problem: &'a str,
    notes: &'a [String],
    rows: &'a [Row],
}

/// The rows as one JSON document.
pub(super) fn json(name: &str, rows: &[Row], notes: &[String]) -> Result<String, Failure> {
    let document = Document {
        schema: 1,
        version: Build::VERSION,
        ipopt: ipopt::version(),
        problem: name,
        notes,
        rows,
    };
    to_json(&document).map_err(|error| Failure::Format {
        path: "compare".into(),
        message: error.to_string(),
    })
}

/// The rows as CSV, a header first.
pub(super) fn csv(rows: &[impl Serialize]) -> Result<String, Failure> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let written = rows.iter().try_for_each(|row| writer.serialize(row));
    let failure = |message: String| Failure::Format {
        path: "compare".into(),
        message,
    };
    written.map_err(|error| failure(error.to_string()))?;
    let bytes = writer
        .into_inner()
        .map_err(|error| failure(error.to_string()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
