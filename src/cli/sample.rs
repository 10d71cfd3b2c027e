//! `sample`: a saved plan at even times.

use super::export::read;
use super::failure::Failure;
use super::out_file::OutFile;
use super::{Outcome, terminal};
use crate::report::{FileSet, Lines, OutputFolder};
use crate::solution::export::{Samples, Times, columns, csv, parquet};
use clap::Args;
use std::path::PathBuf;

/// Name of the file beside a solution.
pub(super) const MOTION: &str = "motion.csv";

/// Write a saved plan at even times, from the polynomials of its states and controls
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Saved solution
    #[arg(value_name = "SOLUTION.json")]
    solution: PathBuf,
    /// Rows a second; the end is a row as well
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    rate: f64,
    /// File to write, .csv or .parquet [default: motion.csv beside the solution]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Reads, samples, writes.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let path = &arguments.solution;
    let beside = || path.with_file_name(MOTION);
    let out = arguments.out.clone().unwrap_or_else(beside);
    let out = OutFile::new(out, &["csv", "parquet"], path)?;
    let saved = read(path)?;
    let samples = Samples::of(
        &saved.file.problem,
        &saved.plan,
        Times::Rate(arguments.rate),
    )
    .map_err(|cause| Failure::Usage(format!("--rate {:?}: {cause}", arguments.rate)))?;
    let folder = OutputFolder::create(&out.folder)?;
    let columns = columns(&samples);
    let mut files = FileSet::new();
    let failed = super::export::failed(path);
    match out.ending.as_str() {
        "csv" => files.add(&folder, &out.name, &csv(&columns).map_err(failed)?),
        _ => files.add_bytes(
            &folder,
            &out.name,
            parquet(&columns, &saved.solution).map_err(failed)?,
        ),
    }
    let mut lines = Lines::default();
    lines.add("rows", samples.t.len().to_string());
    lines.files(&files.write()?);
    terminal::print(&format!("{}\n\n{}", saved.solution.name, lines.finish()))?;
    Ok(saved.solution.status.into())
}
