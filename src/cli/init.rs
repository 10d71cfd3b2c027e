//! `init`: a problem and a robot to begin with.

use super::failure::Failure;
use super::robot;
use super::{Outcome, terminal};
use crate::config::Starter;
use crate::report::{FileSet, Lines, OutputError, OutputFolder};
use clap::Args;
use std::path::{Path, PathBuf};

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
    /// Robot of the problem, instead of an example; what its file has is listed
    #[arg(long, value_name = "FILE")]
    urdf: Option<PathBuf>,
}

/// Writes, says what to do next. Files that are there already stay.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    match &arguments.urdf {
        Some(urdf) => own(&arguments.folder, urdf),
        None => {
            let mut lines = Lines::default();
            let files = FILES.map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec()));
            write(&arguments.folder, &files, &mut lines)?;
            terminal::print(&lines.finish())?;
            Ok(Outcome::Done)
        }
    }
}

/// A first problem for the robot in `urdf`, which is copied unless it is in the folder.
fn own(folder: &Path, urdf: &Path) -> Result<Outcome, Failure> {
    let name = name_in_folder(urdf);
    let starter = Starter::of_urdf(urdf, &name)?;
    let mut files = vec![(
        "problem.toml".to_owned(),
        starter.problem.clone().into_bytes(),
    )];
    let there = folder.join(&name).canonicalize().ok();
    if there.is_none() || there != urdf.canonicalize().ok() {
        let bytes = std::fs::read(urdf).map_err(|error| {
            Failure::Usage(format!("{}: cannot be read: {error}", urdf.display()))
        })?;
        files.push((name, bytes));
    }
    let mut lines = Lines::default();
    robot::list(&starter, urdf, &mut lines);
    write(folder, &files, &mut lines)?;
    for change in &starter.repairs {
        terminal::warn(&format!("warning: {change}"));
    }
    terminal::print(&lines.finish())?;
    Ok(Outcome::Done)
}

/// The name of the robot's file beside the problem.
fn name_in_folder(urdf: &Path) -> String {
    let stem = urdf.file_stem().unwrap_or_default().to_string_lossy();
    let ends = urdf
        .extension()
        .map(|extension| extension.to_string_lossy());
    match ends.as_deref() {
        Some(ends @ ("urdf" | "xml")) => format!("{stem}.{ends}"),
        _ => format!("{stem}.urdf"),
    }
}

/// Writes the files, none of which may be there, the first of them the problem.
fn write(path: &Path, files: &[(String, Vec<u8>)], lines: &mut Lines) -> Result<(), Failure> {
    for (name, _) in files {
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
    for (name, bytes) in files {
        set.add_bytes(&folder, name, bytes);
    }
    let written = set.write()?;
    let problem = written[0].display().to_string();
    lines.files(&written);
    lines.add("look at it", format!("ffsm-ipopt check {problem}"));
    lines.add("plan it", format!("ffsm-ipopt plan {problem}"));
    Ok(())
}
