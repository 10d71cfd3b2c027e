//! `init`: a problem and a robot to begin with.

use super::failure::Failure;
use super::{Outcome, terminal};
use crate::report::{FileSet, Lines, OutputError, OutputFolder};
use clap::Args;
use std::path::PathBuf;

/// Names and texts of the files that are written.
const FILES: [(&str, &str); 2] = [
    (
        "problem.toml",
        include_str!("../../config/starter/problem.toml"),
    ),
    ("arm.urdf", include_str!("../../config/starter/arm.urdf")),
];

/// Write a first problem, with its robot, to change into one's own
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Folder to write to
    #[arg(value_name = "DIR", default_value = ".")]
    folder: PathBuf,
}

/// Writes, says what to do next. Files that are there already stay.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let path = &arguments.folder;
    for (name, _) in FILES {
        let file = path.join(name);
        if file.symlink_metadata().is_ok() {
            return Err(Failure::Usage(format!(
                "{}: is there already and stays as it is; expected a folder without it",
                file.display()
            )));
        }
    }
    let folder = OutputFolder::create(path).map_err(|error| match error {
        OutputError::Folder { path, cause } => Failure::Usage(format!(
            "{}: cannot be written to: {cause}; expected a folder that can",
            path.display()
        )),
        other => other.into(),
    })?;
    let mut set = FileSet::new();
    for (name, text) in FILES {
        set.add(&folder, name, text);
    }
    let files = set.write()?;
    let problem = files[0].display().to_string();
    let mut lines = Lines::default();
    lines.files(&files);
    lines.add("look at it", format!("ffsm-ipopt check {problem}"));
    lines.add("plan it", format!("ffsm-ipopt plan {problem}"));
    terminal::print(&lines.finish())?;
    Ok(Outcome::Done)
}
