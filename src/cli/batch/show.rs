//! `batch show`: what came of a batch, printed again.

use crate::cli::failure::Failure;
use crate::cli::{Outcome, terminal};
use crate::report::BatchReport;
use crate::solution::dataset::DataSet;
use clap::Args;
use std::path::PathBuf;

/// Print how the rows of a data set ended, distributions, and the worst ten
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Folder that a batch wrote to, also while it does
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Print it as one JSON document
    #[arg(long)]
    json: bool,
}

/// Reads, prints.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    print(&DataSet::open(&arguments.folder)?, arguments.json)?;
    Ok(Outcome::Done)
}

/// Prints the report on a data set.
pub(super) fn print(set: &DataSet, json: bool) -> Result<(), Failure> {
    let report = BatchReport::of(set)?;
    let text = report.text();
    if !json {
        return terminal::print(&text);
    }
    let document = report.json().map_err(|error| Failure::Format {
        path: "batch".into(),
        message: error.to_string(),
    })?;
    terminal::print(&document)?;
    terminal::warn(&text);
    Ok(())
}
