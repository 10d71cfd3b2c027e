//! `compare`: one task by every planner.

use super::failure::Failure;
use super::progress::Progress;
use super::{Outcome, interrupt, rows};
use crate::config::{Overrides, ProblemFile};
use crate::nlp::ipopt::interrupt as stop;
use crate::planner::Status;
use crate::report::{ComparisonReport, OutputFolder, comparison_figure};
use crate::study::Comparison;
use clap::Args;
use std::path::{Path, PathBuf};

/// Plan one task by every planner and set the results side by side
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Problem file
    #[arg(value_name = "PROBLEM.toml")]
    problem: PathBuf,
    /// Folder to write to [default: out/<problem name>-compare]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Value for any key of the problem file, as TOML
    #[arg(long, value_name = "key.path=value")]
    set: Vec<String>,
    /// Take the nearest inertia that a body can have for those of the robot that no body has, where
    /// rounding explains it or no joint moves them; short for --set robot.repair=inertia
    #[arg(long)]
    repair: bool,
    /// Print the comparison as one JSON document
    #[arg(long)]
    json: bool,
}

/// Plans, writes, prints.
///
/// The exit status is that of A-RPM, the planner of this program.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let mut overrides = Overrides::of(&arguments.set)?;
    overrides.repair(arguments.repair);
    let file = ProblemFile::load(&arguments.problem, &overrides)?;
    super::plan::say(&file);
    let problem = &file.problem;
    let default = || Path::new("out").join(format!("{}-compare", problem.name));
    let path = arguments.out.clone().unwrap_or_else(default);
    let folder = OutputFolder::create(&path)?;
    interrupt::listen();

    let mut progress = Progress::start(&problem.name, false);
    let found = Comparison::plan(problem, &mut |method, event| {
        progress.retitle(&format!("{}, {}", problem.name, method.name()));
        progress.show(event)
    });
    progress.finish();
    let found = found.map_err(|error| Failure::planning(&file, None, error))?;

    let files = write(&path, &file, &found)?;
    let report = ComparisonReport::of(&problem.name, &found);
    let figure = comparison_figure(problem, &found);
    let to = ("compare", &folder);
    let text = report.markdown();
    rows::write(to, &report, &text, &figure, files, arguments.json)?;
    Ok(outcome(&found))
}

fn outcome(found: &Comparison) -> Outcome {
    if stop::requested() {
        return Outcome::Interrupted;
    }
    match found
        .entries
        .first()
        .and_then(|first| first.plan.as_ref().ok())
    {
        Some(plan) => match plan.status {
            Status::Solved => Outcome::Done,
            Status::Infeasible => Outcome::Infeasible,
            Status::NotConverged => Outcome::NotConverged,
            Status::Interrupted => Outcome::Interrupted,
        },
        None => Outcome::NotConverged,
    }
}

/// Every plan in a folder of its method.
fn write(path: &Path, file: &ProblemFile, found: &Comparison) -> Result<Vec<PathBuf>, Failure> {
    let mut files = Vec::new();
    for entry in &found.entries {
        if let Ok(plan) = &entry.plan {
            let own = OutputFolder::create(&path.join(entry.method.name()))?;
            files.extend(super::plan::write(file, plan, &own)?.1);
        }
    }
    Ok(files)
}
