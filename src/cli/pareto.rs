//! `pareto`: base motion against joint effort.

use super::failure::Failure;
use super::progress::Progress;
use super::{Outcome, interrupt, rows};
use crate::config::{Overrides, ProblemFile};
use crate::nlp::ipopt::interrupt as stop;
use crate::planner::Status;
use crate::report::{FileSet, OutputFolder, ParetoReport};
use crate::study::pareto::{ParetoFront, balanced, factors};
use clap::Args;
use std::path::{Path, PathBuf};

/// Sweep the weight of the base's motion against that of the joints' effort
///
/// The weights of the cost that are about the base (final attitude and position, base rate) are
/// multiplied by a factor, in even ratios; those about the joints stay. Every plan starts from the
/// last one.
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
    super::plan::say(&file);
    let default = || Path::new("out").join(format!("{}-pareto", file.problem.name));
    let folder = OutputFolder::create(&arguments.out.clone().unwrap_or_else(default))?;
    interrupt::listen();

    let (problem, notes) = balanced(&file.problem);
    let mut progress = Progress::start(&problem.name, false);
    let factors = factors(arguments.from, arguments.to, arguments.points);
    let mut front = ParetoFront::new(&problem);
    let swept = front.sweep(&factors, &mut |factor, event| {
        progress.retitle(&format!("{}, base × {factor:.3e}", problem.name));
        progress.show(event)
    });
    progress.finish();
    swept.map_err(|error| Failure::planning(&file, None, error))?;

    let report = ParetoReport::of(&problem.name, front.points(), &notes);
    let to = ("pareto", &folder);
    let (text, figure) = (report.markdown(), report.figure());
    rows::write(to, &report, &text, &figure, FileSet::new(), arguments.json)?;
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
