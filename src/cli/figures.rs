//! `figures`: the paper's figures 2 to 6 from this code's own runs.

use super::failure::Failure;
use super::steps::Steps;
use super::{Outcome, terminal};
use crate::report::{FileSet, OutputFolder};
use crate::reproduction::figures::{self, Plans};
use crate::reproduction::{Session, Step, bounds};
use clap::Args;
use std::path::PathBuf;

/// Draw the paper's figures 2 to 6 from own runs, as SVG and PNG
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Folder to write the figures to
    #[arg(long, value_name = "DIR", default_value = "out/figures")]
    out: PathBuf,
}

/// Plans, draws, writes, prints the captions.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let folder = OutputFolder::create(&arguments.out)?;
    let mut steps = Steps::listen();
    let mut monitor = |step: Step<'_>| steps.show(step);
    let mut session = Session::new(&mut monitor);
    let plans = Plans::make(&mut session)?;
    let (bounded, _) = bounds::bounded(&mut session)?;
    steps.finish();
    let drawn = figures::all(&plans, &bounded);
    let mut set = FileSet::new();
    for one in &drawn {
        set.add_figure(&folder, &one.name, &one.figure)?;
    }
    for (one, files) in drawn.iter().zip(set.write()?.chunks(2)) {
        let files: String = files
            .iter()
            .map(|f| format!("  {}\n", f.display()))
            .collect();
        terminal::print(&format!("{}\n{files}", one.caption))?;
    }
    Ok(Outcome::Done)
}
