//! `table2`: the paper's comparison of the global and the adaptive method.

use super::failure::Failure;
use super::steps::Steps;
use super::{Outcome, terminal};
use crate::nlp::ipopt;
use crate::report::{FileSet, OutputFolder};
use crate::reproduction::table2::{self, Row, SensitivityRow, SweepRow};
use crate::solution::{Build, to_json};
use clap::Args;
use serde::Serialize;
use std::path::PathBuf;

/// Run the paper's Table II: global RPM against A-RPM at three tolerances
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Folder to write table2.md, table2.csv and table2.json to
    #[arg(long, value_name = "DIR", default_value = "out/table2")]
    out: PathBuf,
    /// Runs of each case; the median time is shown
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..))]
    repeat: u16,
    /// Also A-RPM over a grid of λ₁, λ₂ and r_max
    #[arg(long)]
    sensitivity: bool,
    /// Also both methods along a sweep of the control's weight from 1 to 0
    #[arg(long)]
    sweep: bool,
}

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    version: &'static str,
    ipopt: &'static str,
    repeat: u16,
    rows: &'a [Row],
    #[serde(skip_serializing_if = "Option::is_none")]
    sensitivity: Option<&'a [SensitivityRow]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    sweep: Option<&'a [SweepRow]>,
}

/// Runs, writes, prints.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let folder = OutputFolder::create(&arguments.out)?;
    let mut steps = Steps::listen();
    let mut monitor = |step: crate::reproduction::Step<'_>| steps.show(step);
    let mut session = crate::reproduction::Session::new(&mut monitor);
    let rows = table2::rows(&mut session, arguments.repeat)?;
    let sensitivity = arguments
        .sensitivity
        .then(|| table2::sensitivity(&mut session))
        .transpose()?;
    let sweep = arguments
        .sweep
        .then(|| table2::sweep(&mut session))
        .transpose()?;
    steps.finish();
    let mut text = table2::markdown(&rows, arguments.repeat);
    let mut files = vec![("table2.csv", table2::sheet(&rows).csv())];
    if let Some(rows) = &sensitivity {
        text.push_str(&table2::sensitivity_markdown(rows));
        files.push(("sensitivity.csv", table2::sensitivity_sheet(rows).csv()));
    }
    if let Some(rows) = &sweep {
        text.push_str(&table2::sweep_markdown(rows));
        files.push(("sweep.csv", table2::sweep_sheet(rows).csv()));
    }
    let document = Document {
        schema: 1,
        version: Build::VERSION,
        ipopt: ipopt::version(),
        repeat: arguments.repeat,
        rows: &rows,
        sensitivity: sensitivity.as_deref(),
        sweep: sweep.as_deref(),
    };
    let json = to_json(&document).map_err(|error| Failure::Format {
        path: "table2.json".into(),
        message: error.to_string(),
    })?;
    terminal::print(&text)?;
    files.push(("table2.json", json));
    files.push(("table2.md", text));
    let mut set = FileSet::new();
    for (name, contents) in &files {
        set.add(&folder, name, contents);
    }
    if let Some(rows) = &sweep {
        set.add_figure(&folder, "sweep", &table2::sweep_figure(rows))?;
    }
    for path in set.write()? {
        terminal::print(&format!("written {}\n", path.display()))?;
    }
    Ok(Outcome::Done)
}
