//! `compare`: one task by every planner.

use super::failure::Failure;
use super::plan::Page;
use super::progress::Progress;
use super::search::SearchArguments;
use super::{Outcome, interrupt, rows};
use crate::config::{Overrides, ProblemFile};
use crate::nlp::ipopt::interrupt as stop;
use crate::planner::Method;
use crate::refine;
use crate::report::{ComparisonReport, FileSet, OutputFolder, comparison_figure};
use crate::study::{Baselines, Comparison};
use clap::Args;
use std::path::{Path, PathBuf};

/// Plan one task by every planner and set the results side by side
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Problem file
    #[arg(value_name = "PROBLEM.toml")]
    problem: PathBuf,
    #[command(flatten)]
    search: SearchArguments,
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
    let adaptive = Method::Collocation(refine::Method::Adaptive);
    let search = arguments.search.of(adaptive)?.map(|(search, _)| search);
    super::plan::say(&file);
    let problem = &file.problem;
    let default = || Path::new("out").join(format!("{}-compare", problem.name));
    let path = arguments.out.clone().unwrap_or_else(default);
    let folder = OutputFolder::create(&path)?;
    interrupt::listen();

    let mut progress = Progress::start(&problem.name, false);
    let found = Comparison::plan(problem, search.as_ref(), &mut |method, event| {
        progress.retitle(&format!("{}, {}", problem.name, method.name()));
        progress.show_search(event)
    });
    progress.finish();
    let found = found.map_err(|error| Failure::planning(&file, None, error))?;

    let mut set = FileSet::new();
    add(&path, &file, &found, &mut set)?;
    let report = ComparisonReport::of(&problem.name, &found);
    let figure = comparison_figure(problem, &found);
    let to = ("compare", &folder);
    let text = report.markdown();
    rows::write(to, &report, &text, &figure, set, arguments.json)?;
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
        Some(plan) => plan.status.into(),
        None => Outcome::NotConverged,
    }
}

/// Adds every plan to `set`, in a folder of its method; where a method has none, those of an earlier
/// comparison go.
fn add(
    path: &Path,
    file: &ProblemFile,
    found: &Comparison,
    set: &mut FileSet,
) -> Result<(), Failure> {
    for method in Method::ALL {
        let own = path.join(method.name());
        match found.by(method) {
            Some(plan) => {
                let own = OutputFolder::create(&own)?;
                let optima = found.optima.as_ref().filter(|_| method == Method::ALL[0]);
                let baselines = Baselines::of(&file.problem, &plan.discretization);
                super::plan::add(file, plan, Page::Made(&baselines), optima, &own, set)?;
            }
            None if own.is_dir() => super::plan::remove(&OutputFolder::create(&own)?, set),
            None => {}
        }
    }
    Ok(())
}
