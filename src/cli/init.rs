//! `init`: a problem and a robot to begin with.

use super::failure::Failure;
use super::robot;
use super::{Outcome, terminal};
use crate::config::{Starter, SurfaceCopies, SurfaceCopy};
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
    let mut lines = Lines::default();
    match &arguments.urdf {
        Some(urdf) => own(&arguments.folder, urdf, &mut lines)?,
        None => {
            let files = FILES.map(|(name, text)| (name.into(), text.as_bytes().to_vec()));
            written(&write(&arguments.folder, files.into())?, &mut lines);
        }
    }
    terminal::print(&lines.finish())?;
    Ok(Outcome::Done)
}

/// A first problem for the robot in `urdf`, which is copied unless it is in the folder, together with
/// the surfaces that it names.
fn own(folder: &Path, urdf: &Path, lines: &mut Lines) -> Result<(), Failure> {
    let name = name_in_folder(urdf);
    let starter = Starter::of_urdf(urdf, &name)?;
    let problem = starter.problem.clone().into_bytes();
    let mut files: Vec<Contents> = vec![("problem.toml".into(), problem)];
    let mut surfaces = SurfaceCopies::default();
    let there = folder.join(&name).canonicalize().ok();
    if there.is_none() || there != urdf.canonicalize().ok() {
        let bytes = std::fs::read(urdf).map_err(|error| {
            Failure::Usage(format!("{}: cannot be read: {error}", urdf.display()))
        })?;
        files.push((name.into(), bytes));
        surfaces = starter.surfaces();
    }
    let own = files.len();
    let is_new = |surface: &SurfaceCopy| {
        let there = folder.join(&surface.place).canonicalize();
        !there.is_ok_and(|there| there == surface.source)
    };
    let new = surfaces.files.into_iter().filter(is_new);
    files.extend(new.map(|surface| (surface.place, surface.bytes)));
    let sizes = files[own..].iter().map(|(_, bytes)| bytes.len());
    let (count, size) = (sizes.len(), sizes.sum::<usize>());
    robot::list(&starter, urdf, lines);
    let all = write(folder, files)?;
    if count > 0 {
        let size = size as f64 / 1e6;
        lines.add("surfaces copied", format!("{count}, {size:.1} MB"));
    }
    written(&all[..own], lines);
    for change in &starter.repairs {
        terminal::warn(&format!("warning: {change}"));
    }
    not_drawn(&surfaces.complaints);
    Ok(())
}

/// Most surfaces of which it is said why they are not drawn.
const COMPLAINTS: usize = 6;

fn not_drawn(complaints: &[String]) {
    for complaint in complaints.iter().take(COMPLAINTS) {
        terminal::warn(&format!("warning: not drawn: {complaint}"));
    }
    if complaints.len() > COMPLAINTS {
        let more = complaints.len() - COMPLAINTS;
        terminal::warn(&format!("warning: not drawn: {more} more"));
    }
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

/// A file's path in the folder, and what it is to hold.
type Contents = (PathBuf, Vec<u8>);

/// Writes the files, none of which may be there; their paths are returned.
fn write(path: &Path, files: Vec<Contents>) -> Result<Vec<PathBuf>, Failure> {
    for (name, _) in &files {
        is_free(path, name)?;
    }
    let folder = create(path)?;
    let mut set = FileSet::new();
    for (name, bytes) in files {
        if let Some(within) = name.parent().filter(|within| *within != Path::new("")) {
            create(&path.join(within))?;
        }
        set.add_bytes(&folder, name, bytes);
    }
    Ok(set.write()?)
}

fn create(path: &Path) -> Result<OutputFolder, Failure> {
    OutputFolder::create(path).map_err(|error| match error {
        OutputError::Folder { path, cause } => Failure::Usage(format!(
            "{}: cannot be written to: {cause}; expected a folder that can",
            path.display()
        )),
        other => other.into(),
    })
}

/// Nothing may be at `folder/name`, and no link on the way there, which would lead out of the folder.
fn is_free(folder: &Path, name: &Path) -> Result<(), Failure> {
    let taken = |path: PathBuf| {
        Failure::Usage(format!(
            "{}: is there already and stays as it is; expected a folder without it",
            path.display()
        ))
    };
    let mut path = folder.to_path_buf();
    for part in name.parent().into_iter().flat_map(Path::components) {
        path.push(part);
        match path.symlink_metadata() {
            Ok(found) if !found.is_dir() => return Err(taken(path)),
            _ => {}
        }
    }
    let path = folder.join(name);
    match path.symlink_metadata() {
        Ok(_) => Err(taken(path)),
        Err(_) => Ok(()),
    }
}

/// Where the files are, the first of them the problem, and what to do with it.
fn written(files: &[PathBuf], lines: &mut Lines) {
    let problem = files[0].display().to_string();
    lines.files(files);
    lines.add("look at it", format!("ffsm-ipopt check {problem}"));
    lines.add("plan it", format!("ffsm-ipopt plan {problem}"));
}
