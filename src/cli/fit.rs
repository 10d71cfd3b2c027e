//! `simulate --fit`: platform parameters from published measurements.

use super::failure::Failure;
use super::steps::Steps;
use super::{Outcome, terminal};
use crate::config::FitFile;
use crate::report::{FileSet, OutputFolder};
use crate::reproduction::{Session, Step, platform};
use std::path::{Path, PathBuf};

/// Reads, plans, fits, writes, prints.
pub(super) fn run(path: &Path, out: Option<&PathBuf>) -> Result<Outcome, Failure> {
    let file = FitFile::load(path)?;
    let folder = Path::new("out").join(&file.name);
    let folder = OutputFolder::create(out.unwrap_or(&folder))?;
    let mut steps = Steps::listen();
    let mut monitor = |step: Step<'_>| steps.show(step);
    let report = platform::fit(&mut Session::new(&mut monitor), &file)?;
    steps.finish();
    let json = report.json().map_err(|error| Failure::Format {
        path: file.path.clone(),
        message: error.to_string(),
    })?;
    let text = report.markdown();
    let mut set = FileSet::new();
    set.add(&folder, "fit.md", &text);
    set.add(&folder, "fit.json", &json);
    let files = set.write()?;
    terminal::results(&text, &files, None)?;
    Ok(Outcome::Done)
}
