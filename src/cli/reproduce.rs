//! `reproduce`: everything that docs/reproduction.md is written from.

use super::failure::Failure;
use super::steps::Steps;
use super::{Outcome, terminal};
use crate::report::{OutputFolder, to_json};
use crate::reproduction::document::{self, Findings};
use crate::reproduction::figures::{self, Drawn, Plans};
use crate::reproduction::{Session, Step, bounds, table2};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Reproduce the paper: tables, figures, proofs and a verdict on each claim
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Only this part, printed and not written
    part: Option<Part>,
    /// Folder to write reproduction.md, its data and its figures to
    #[arg(long, value_name = "DIR", default_value = "out/reproduction")]
    out: PathBuf,
    /// Runs behind each row of Table II; the median time is shown
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..))]
    repeat: u16,
}

/// A part that can be had alone.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Part {
    /// Why the published case has no solution
    Bounds,
}

/// Runs, writes, prints.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    match arguments.part {
        Some(Part::Bounds) => {
            let mut steps = Steps::listen();
            let mut monitor = |step: Step<'_>| steps.show(step);
            let (found, _) = bounds::bounds(&mut Session::new(&mut monitor))?;
            steps.finish();
            terminal::print(&bounds::markdown(&found))?;
            Ok(Outcome::Done)
        }
        None => all(arguments),
    }
}

fn all(arguments: &Arguments) -> Result<Outcome, Failure> {
    let folder = OutputFolder::create(&arguments.out)?;
    let pictures = OutputFolder::create(&arguments.out.join("figures"))?;
    let mut steps = Steps::listen();
    let mut monitor = |step: Step<'_>| steps.show(step);
    let mut session = Session::new(&mut monitor);
    let (found, bounded) = bounds::bounds(&mut session)?;
    let plans = Plans::make(&mut session)?;
    let findings = Findings {
        repeat: arguments.repeat,
        rows: table2::rows(&mut session, arguments.repeat)?,
        sensitivity: table2::sensitivity(&mut session)?,
        sweep: table2::sweep(&mut session)?,
        bounds: found,
        figures: figures::all(&plans, &bounded),
        bounded,
        plans,
    };
    steps.finish();
    let sheets = [
        ("table2.csv", table2::sheet(&findings.rows)),
        (
            "sensitivity.csv",
            table2::sensitivity_sheet(&findings.sensitivity),
        ),
        ("sweep.csv", table2::sweep_sheet(&findings.sweep)),
    ];
    for (name, sheet) in sheets {
        folder.write(name, &sheet.csv())?;
    }
    let json = to_json(&findings.bounds).map_err(|error| Failure::Format {
        path: "bounds.json".into(),
        message: error.to_string(),
    })?;
    folder.write("bounds.json", &json)?;
    pictures.write_figure("sweep", &table2::sweep_figure(&findings.sweep))?;
    for Drawn { name, figure, .. } in &findings.figures {
        pictures.write_figure(name, figure)?;
    }
    let text = document::markdown(&findings);
    let path = folder.write("reproduction.md", &text)?;
    terminal::print(&format!("written {}\n", path.display()))?;
    Ok(Outcome::Done)
}
