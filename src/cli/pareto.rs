//! `pareto`: base motion against joint effort.

use super::failure::Failure;
use super::progress::Progress;
use super::search::SearchArguments;
use super::{Outcome, interrupt, rows};
use crate::config::{Overrides, ProblemFile};
use crate::nlp::ipopt::interrupt as stop;
use crate::planner::{Method, Status};
use crate::report::{FileSet, OutputFolder, ParetoReport};
use crate::study::pareto::{ParetoFront, balanced, factors};
use crate::study::search::SearchEvent;
use clap::Args;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Sweep the weight of the base's motion against that of the joints' effort
///
/// The weights of the cost that are about the base (final attitude and position, base rate) are
/// multiplied by a factor, in even ratios; those about the joints stay. Every plan starts from the
/// one before and a few other starts, at the largest factor from many; further points are planned
/// where neighbours are farthest apart.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Problem file
    #[arg(value_name = "PROBLEM.toml")]
    problem: PathBuf,
    /// Points of the curve
    #[arg(long, value_name = "N", default_value_t = 9, value_parser = clap::value_parser!(u16).range(2..=1000))]
    points: u16,
    /// Smallest factor on the base's weights
    #[arg(long, value_name = "FACTOR", default_value_t = 0.01, value_parser = factor)]
    from: f64,
    /// Largest factor on the base's weights
    #[arg(long, value_name = "FACTOR", default_value_t = 100.0, value_parser = factor)]
    to: f64,
    /// Further points, where neighbours are farthest apart [default: a third of --points]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(0..=1000))]
    fill: Option<u16>,
    #[command(flatten)]
    search: SearchArguments,
    /// Limit on the time of the whole curve, shared out among its points
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time_limit: Option<Duration>,
    /// Folder to write to [default: out/<problem name>-pareto]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Value for any key of the problem file, as TOML
    #[arg(long, value_name = "key.path=value")]
    set: Vec<String>,
    /// Take the nearest inertia that a body can have for those of the robot that no body has, where
    /// rounding explains it or no joint moves them; short for --set robot.repair=inertia
    #[arg(long)]
    repair: bool,
    /// Print the curve as one JSON document
    #[arg(long)]
    json: bool,
}

fn factor(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() && value > 0.0 => Ok(value),
        _ => Err("expected a finite number above zero".into()),
    }
}

fn seconds(text: &str) -> Result<Duration, String> {
    let number = factor(text)?;
    Duration::try_from_secs_f64(number).map_err(|error| error.to_string())
}

/// Plans, writes, prints.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    if arguments.from >= arguments.to {
        return Err(Failure::Usage(format!(
            "--from {} is not below --to {}",
            arguments.from, arguments.to
        )));
    }
    let mut overrides = Overrides::of(&arguments.set)?;
    overrides.repair(arguments.repair);
    let file = ProblemFile::load(&arguments.problem, &overrides)?;
    let method = Method::Collocation(file.problem.mesh.method);
    let search = arguments.search.of(method)?;
    super::plan::say(&file);
    let default = || Path::new("out").join(format!("{}-pareto", file.problem.name));
    let folder = OutputFolder::create(&arguments.out.clone().unwrap_or_else(default))?;
    interrupt::listen();

    let (problem, notes) = balanced(&file.problem);
    let mut progress = Progress::start(&problem.name, false);
    let factors = factors(arguments.from, arguments.to, arguments.points);
    let mut front = ParetoFront::new(&problem);
    if let Some((search, _)) = search {
        front = front.searching(search);
    }
    if let Some(limit) = arguments.time_limit {
        front = front.within(limit);
    }
    let further = usize::from(arguments.fill.unwrap_or(arguments.points / 3));
    let mut monitor = |factor: f64, event: &SearchEvent<'_>| {
        progress.retitle(&format!("{}, base × {factor:.3e}", problem.name));
        progress.show_search(event)
    };
    let swept = front
        .sweep(&factors, &mut monitor)
        .and_then(|()| front.fill(further, &mut monitor));
    progress.finish();
    swept.map_err(|error| Failure::planning(&file, None, error))?;

    let report = ParetoReport::of(&problem.name, front.points(), &notes);
    let to = ("pareto", &folder);
    let (text, figure) = (report.markdown(), report.figure());
    let mut set = FileSet::new();
    set.add(&folder, "pareto.html", &report.page());
    rows::write(to, &report, &text, &figure, set, arguments.json)?;
    Ok(outcome(
        front.points().iter().map(|point| point.plan.status),
    ))
}

/// Solved where all are; else what went wrong first.
fn outcome(statuses: impl Iterator<Item = Status>) -> Outcome {
    if stop::requested() {
        return Outcome::Interrupted;
    }
    let mut failed = statuses.filter(|status| *status != Status::Solved);
    match failed.next() {
        None => Outcome::Done,
        Some(Status::Infeasible) => Outcome::Infeasible,
        Some(Status::Interrupted) => Outcome::Interrupted,
        Some(_) => Outcome::NotConverged,
    }
}
