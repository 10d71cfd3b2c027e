//! Table II as Markdown, CSV and JSON, beside the published figures.

use super::failure::Failure;
use super::show::rounded;
use crate::nlp::ipopt;
use crate::planner::{Method, Plan, Status};
use crate::refine;
use crate::report::{Build, to_json};
use comfy_table::{CellAlignment, Table, presets};
use serde::Serialize;

/// Figures of Table II.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
struct Published {
    points: usize,
    seconds: f64,
    max_error: f64,
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
pub(super) struct Row {
    problem: String,
    tolerance: f64,
    method: &'static str,
    reached: bool,
    status: &'static str,
    points: usize,
    segments: usize,
    solves: usize,
    /// Median wall time, s.
    seconds: f64,
    max_error: Option<f64>,
    objective: Option<f64>,
    published: Option<Published>,
}

impl Row {
    /// The row of several runs of one case; `None` where there were none.
    pub(super) fn of(problem: &str, plans: &[Plan]) -> Option<Self> {
        let plan = plans.last()?;
        let mesh = &plan.discretization.mesh;
        let finite = |value: f64| value.is_finite().then_some(value);
        let published = PUBLISHED
            .iter()
            .find(|(tolerance, ..)| *tolerance == plan.tolerance);
        Some(Self {
            problem: problem.into(),
            tolerance: plan.tolerance,
            method: plan.method.name(),
            reached: plan.status == Status::Solved,
            status: plan.status.name(),
            points: mesh.points(),
            segments: mesh.segments(),
            solves: plan.iterations.len(),
            seconds: median(
                plans
                    .iter()
                    .map(|plan| plan.timing.total.as_secs_f64())
                    .collect(),
            ),
            max_error: finite(plan.max_error),
            objective: finite(plan.objective),
            published: published.map(|(_, global, adaptive)| match plan.method {
                Method::Collocation(refine::Method::Global) => *global,
                _ => *adaptive,
            }),
        })
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    match values.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => values[n / 2],
        n => 0.5 * (values[n / 2 - 1] + values[n / 2]),
    }
}

/// One table a problem.
pub(super) fn markdown(rows: &[Row], repeat: u16) -> String {
    let mut text = format!(
        "Table II: global RPM against A-RPM, beside the published figures.\n\n\
         Wall time from the start of planning, median of {repeat}; error is the largest of (28).\n\
         The published case itself has no solution (see `config/table1.toml`), so that only the\n\
         trend can be compared. ffsm-ipopt {}, Ipopt {}.\n",
        Build::VERSION,
        ipopt::version()
    );
    for group in rows.chunk_by(|a, b| a.problem == b.problem) {
        text.push_str(&format!("\n`{}`\n\n{}\n", group[0].problem, table(group)));
    }
    text.push('\n');
    text
}

fn table(rows: &[Row]) -> Table {
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN).set_header([
        "tolerance",
        "method",
        "points",
        "solves",
        "time / s",
        "error",
        "J",
        "reached",
        "published points",
        "published time / s",
        "published error",
    ]);
    let shown = |value: Option<f64>, decimals: usize| {
        value.map_or_else(|| "–".into(), |value| format!("{value:.decimals$e}"))
    };
    for row in rows {
        let published = |show: fn(&Published) -> String| {
            row.published.as_ref().map_or_else(|| "–".into(), show)
        };
        table.add_row([
            format!("{:e}", row.tolerance),
            row.method.into(),
            row.points.to_string(),
            row.solves.to_string(),
            format!("{:.4}", row.seconds),
            shown(row.max_error, 3),
            row.objective
                .map_or_else(|| "–".into(), |value| format!("{value:.7}")),
            if row.reached {
                "yes".into()
            } else {
                "not reached".into()
            },
            published(|published| published.points.to_string()),
            published(|published| rounded(published.seconds)),
            published(|published| format!("{:.3e}", published.max_error)),
        ]);
    }
    for column in table.column_iter_mut() {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    version: &'static str,
    ipopt: &'static str,
    repeat: u16,
    rows: &'a [Row],
}

/// The rows as JSON and as CSV.
pub(super) fn data(rows: &[Row], repeat: u16) -> Result<(String, String), Failure> {
    let failure = |message: String| Failure::Format {
        path: "table2".into(),
        message,
    };
    let document = Document {
        schema: 1,
        version: Build::VERSION,
        ipopt: ipopt::version(),
        repeat,
        rows,
    };
    let json = to_json(&document).map_err(|error| failure(error.to_string()))?;
    let mut writer = csv::Writer::from_writer(Vec::new());
    let header = [
        "problem",
        "tolerance",
        "method",
        "reached",
        "status",
        "points",
        "segments",
        "solves",
        "seconds",
        "max_error",
        "objective",
        "published_points",
        "published_seconds",
        "published_max_error",
    ];
    let fill = |writer: &mut csv::Writer<Vec<u8>>| -> csv::Result<()> {
        writer.write_record(header)?;
        rows.iter().try_for_each(|row| {
            let published = row.published;
            writer.serialize((
                (
                    &row.problem,
                    row.tolerance,
                    row.method,
                    row.reached,
                    row.status,
                ),
                (
                    row.points,
                    row.segments,
                    row.solves,
                    row.seconds,
                    row.max_error,
                    row.objective,
                ),
                published.map(|published| published.points),
                published.map(|published| published.seconds),
                published.map(|published| published.max_error),
            ))
        })
    };
    fill(&mut writer).map_err(|error| failure(error.to_string()))?;
    let bytes = writer
        .into_inner()
        .map_err(|error| failure(error.to_string()))?;
    Ok((json, String::from_utf8_lossy(&bytes).into_owned()))
}
