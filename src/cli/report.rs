//! `report`: a saved plan as a page to look at.

use super::failure::Failure;
use super::out_file::OutFile;
use super::{Outcome, terminal};
use crate::report::{Lines, OutputFolder, in_doubt, page};
use crate::solution::Saved;
use crate::study::Baselines;
use clap::Args;
use std::path::PathBuf;

/// Make a page of a saved plan: its motion played back, charts with their bounds, why to trust it
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Saved solution
    #[arg(value_name = "SOLUTION.json")]
    solution: PathBuf,
    /// File to write [default: report.html beside the solution]
    #[arg(long, value_name = "FILE.html")]
    out: Option<PathBuf>,
}

/// Reads, writes, says where.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let path = &arguments.solution;
    let beside = || path.with_file_name("report.html");
    let out = arguments.out.clone().unwrap_or_else(beside);
    let out = OutFile::new(out, &["html", "htm"], path)?;
    let saved = Saved::load(path)?;
    let problem = &saved.file.problem;
    let folder = OutputFolder::create(&out.folder)?;
    let (solution, doubt) = saved.again();
    let baselines = Baselines::of(problem, &saved.plan);
    let drawing = saved.file.appearance.drawing(&saved.file.robot);
    let page = page(&solution, problem, (&saved.plan, &baselines), &drawing);
    folder.write(&out.name, &page)?;
    let mut lines = Lines::default();
    lines.files(&[out.path]);
    let (heading, outcome) = match &doubt {
        Some(doubt) => (
            in_doubt(&problem.name, saved.solution.status, doubt),
            Outcome::NotConverged,
        ),
        None => (problem.name.clone(), Outcome::Done),
    };
    terminal::print(&format!("{heading}\n\n{}", lines.finish()))?;
    Ok(outcome)
}
