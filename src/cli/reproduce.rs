//! `reproduce`: everything that docs/reproduction.md is written from.

use super::failure::Failure;
use super::search::SearchArguments;
use super::steps::Steps;
use super::{Outcome, terminal};
use crate::planner::Method;
use crate::refine;
use crate::report::{FileSet, OutputFolder};
use crate::reproduction::document::{self, Findings};
use crate::reproduction::figures::Drawn;
use crate::reproduction::platform::Platform;
use crate::reproduction::{Session, Step, bounds};
use crate::study::search::Search;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Reproduce the paper: tables, figures, proofs and a verdict on each claim
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Only this part, printed and not written
    part: Option<Part>,
    #[command(flatten)]
    search: SearchArguments,
    /// Folder to write reproduction.md, its data and its figures to
    #[arg(long, value_name = "DIR", default_value = "out/reproduction")]
    out: PathBuf,
    /// Runs behind each row of Table II; the median time is shown
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..))]
    repeat: u16,
}

/// A part that can be had alone.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Part {
    /// Why the published case has no solution
    Bounds,
    /// What explains the measurements on the ground platform
    Platform,
}

/// Runs, writes, prints.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let adaptive = Method::Collocation(refine::Method::Adaptive);
    let search = arguments.search.of(adaptive)?.map(|(search, _)| search);
    match arguments.part {
        Some(_) if search.is_some() => Err(Failure::Usage(
            "--search is for all of the reproduction: its comparisons and fronts search, no part does"
                .into(),
        )),
        Some(part) => alone(part),
        None => all(arguments, search),
    }
}

fn alone(part: Part) -> Result<Outcome, Failure> {
    let mut steps = Steps::listen();
    let mut monitor = |step: Step<'_>| steps.show(step);
    let mut session = Session::new(&mut monitor);
    let text = match part {
        Part::Bounds => bounds::markdown(&bounds::bounds(&mut session)?.0),
        Part::Platform => Platform::examine(&mut session)?.markdown(),
    };
    steps.finish();
    terminal::print(&text)?;
    Ok(Outcome::Done)
}

fn all(arguments: &Arguments, search: Option<Search>) -> Result<Outcome, Failure> {
    let folder = OutputFolder::create(&arguments.out)?;
    let pictures = OutputFolder::create(&arguments.out.join("figures"))?;
    let mut steps = Steps::listen();
    let mut monitor = |step: Step<'_>| steps.show(step);
    let mut session = Session::new(&mut monitor).searching(search);
    let findings = Findings::gather(&mut session, arguments.repeat)?;
    steps.finish();
    let mut set = FileSet::new();
    set.add(&folder, "reproduction.md", &document::markdown(&findings));
    for (name, text) in document::data(&findings)? {
        set.add(&folder, &name, &text);
    }
    for Drawn { name, figure, .. } in document::pictures(&findings) {
        set.add_figure(&pictures, &name, &figure)?;
    }
    if let Some(path) = set.write()?.first() {
        terminal::print(&format!("written {}\n", path.display()))?;
    }
    Ok(Outcome::Done)
}
