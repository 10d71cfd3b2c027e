//! `verify`: a saved plan integrated again.

use super::failure::Failure;
use super::plan::VERIFICATION;
use super::{Outcome, terminal};
use crate::report::{OutputFolder, verification_json, verification_summary};
use crate::solution::Saved;
use clap::Args;
use std::path::{Path, PathBuf};

/// Integrate a saved plan again with the full dynamics and report how far it drifts
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Saved solution
    #[arg(value_name = "SOLUTION.json")]
    solution: PathBuf,
    /// Folder to write verification.json to [default: out/<problem name>]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Reads, integrates, writes, prints.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let path = &arguments.solution;
    let saved = Saved::load(path)?;
    let problem = &saved.file.problem;
    let default = || Path::new("out").join(&problem.name);
    let folder = OutputFolder::create(&arguments.out.clone().unwrap_or_else(default))?;
    let judgement = saved.judge();
    let json = verification_json(path, &saved, &judgement).map_err(|error| Failure::Format {
        path: path.display().to_string(),
        message: error.to_string(),
    })?;
    let files = [folder.write(VERIFICATION, &json)?];
    terminal::print(&verification_summary(&saved, &judgement, &files))?;
    Ok(match judgement.doubt {
        Some(_) => Outcome::NotConverged,
        None => Outcome::Done,
    })
}
