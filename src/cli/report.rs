//! `report`: a saved plan as a page to look at.

use super::failure::Failure;
use super::{Outcome, terminal};
use crate::report::{Lines, OutputFolder, page};
use crate::solution::Saved;
use crate::verify::check;
use clap::Args;
use std::path::{Path, PathBuf};

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
    let saved = Saved::load(path)?;
    let problem = &saved.file.problem;
    check(problem, &saved.plan).map_err(|cause| Failure::Verify {
        path: path.display().to_string(),
        cause,
    })?;
    let beside = || path.with_file_name("report.html");
    let out = arguments.out.clone().unwrap_or_else(beside);
    let name = out.file_name().and_then(|name| name.to_str());
    let Some(name) = name.filter(|_| !out.is_dir()) else {
        return Err(Failure::Usage(format!(
            "--out {}: expected the name of a file",
            out.display()
        )));
    };
    let within = match out.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let folder = OutputFolder::create(within)?;
    let html = page(&saved.solution, problem, &saved.plan);
    folder.write(name, &html)?;
    let mut lines = Lines::default();
    lines.files(&[out]);
    terminal::print(&format!("{}\n\n{}", problem.name, lines.finish()))?;
    Ok(Outcome::Done)
}
