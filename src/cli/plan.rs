//! `plan`: one problem, one trajectory.

use super::failure::Failure;
use super::progress::Progress;
use super::sample::MOTION;
use super::search::SearchArguments;
use super::{Outcome, interrupt, terminal};
use crate::config::{ConfigError, Overrides, ProblemFile};
use crate::planner::{Method, Plan, PlanError, Planner, Start, Status};
use crate::problem::Problem;
use crate::report::{self, FileSet, OutputFolder};
use crate::solution::export::{Samples, Times, columns, csv, even_times};
use crate::solution::{self, Provenance};
use crate::study::Baselines;
use crate::study::search::{Optima, Search};
use crate::{parallel, refine, verify};
use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Plan one trajectory and write it to a folder
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Problem file
    #[arg(value_name = "PROBLEM.toml")]
    problem: PathBuf,
    /// Folder to write to [default: out/<problem name>]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Method, instead of the problem file's
    #[arg(long)]
    method: Option<MethodName>,
    /// Tolerance on the largest error, instead of the problem file's
    #[arg(long, value_name = "E", allow_negative_numbers = true)]
    tolerance: Option<f64>,
    /// Limit on the time of planning, its diagnosis included; the best trajectory until then is written
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    time_limit: Option<f64>,
    /// Value for any key of the problem file, as TOML
    #[arg(long, value_name = "key.path=value")]
    set: Vec<String>,
    /// Take the nearest inertia that a body can have for those of the robot that no body has, where
    /// rounding explains it or no joint moves them; short for --set robot.repair=inertia
    #[arg(long)]
    repair: bool,
    /// Saved solution to start from
    #[arg(long, value_name = "solution.json")]
    warm_start: Option<PathBuf>,
    #[command(flatten)]
    search: SearchArguments,
    /// Write motion.csv as well: so many rows a second, as `sample` does
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    sample: Option<f64>,
    /// Do not make the page report.html
    #[arg(long)]
    no_report: bool,
    /// Print the solution as one JSON document
    #[arg(long)]
    json: bool,
    /// Print neither progress nor summary
    #[arg(long)]
    quiet: bool,
}

const SOLUTION: &str = "solution.json";
const TRAJECTORY: &str = "trajectory.csv";
const PAGE: &str = "report.html";
/// What `verify` writes.
pub(super) const VERIFICATION: &str = "verification.json";

/// A planner by its name.
#[derive(Debug, Clone, Copy)]
struct MethodName(Method);

impl ValueEnum for MethodName {
    fn value_variants<'a>() -> &'a [Self] {
        const NAMES: [MethodName; Method::ALL.len()] = {
            let mut names = [MethodName(Method::ALL[0]); Method::ALL.len()];
            let mut i = 0;
            while i < names.len() {
                names[i] = MethodName(Method::ALL[i]);
                i += 1;
            }
            names
        };
        &NAMES
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.0.name()).help(self.0.describe()))
    }
}

impl Arguments {
    fn overrides(&self) -> Result<Overrides, ConfigError> {
        let mut overrides = Overrides::of(&self.set)?;
        overrides.repair(self.repair);
        // The other planners change nothing of the problem.
        if let Some(MethodName(Method::Collocation(method))) = self.method {
            let name = method.name();
            overrides.text(&format!("--method {name}"), "mesh.method", name);
        }
        if let Some(tolerance) = self.tolerance {
            overrides.number(
                &format!("--tolerance {tolerance:?}"),
                "mesh.tolerance",
                tolerance,
            );
        }
        if let Some(limit) = self.time_limit {
            let flag = format!("--time-limit {limit:?}");
            overrides.number(&flag, "solver.time_limit", limit);
        }
        Ok(overrides)
    }
}

/// Plans, writes, prints.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let file = ProblemFile::load(&arguments.problem, &arguments.overrides()?)?;
    let of_file = Method::Collocation(file.problem.mesh.method);
    let method = arguments
        .method
        .map_or(of_file, |MethodName(method)| method);
    let search = arguments.search.of(method)?;
    let warm_start = arguments.warm_start.as_deref();
    let start = warm_start
        .map(|path| solution::read_warm_start(path, &file))
        .transpose()?;
    if let Some(rate) = arguments.sample {
        let duration = file.problem.task.duration.lower;
        even_times(rate, duration)
            .map_err(|cause| Failure::Usage(format!("--sample {rate:?}: {cause}")))?;
    }
    let default = || Path::new("out").join(&file.problem.name);
    let folder = OutputFolder::create(&arguments.out.clone().unwrap_or_else(default))?;

    if !arguments.quiet {
        say(&file);
        if let Some(other) = start.as_ref().and_then(|start| start.other_robot.as_ref()) {
            terminal::complain(&format!("note: {other}"));
        }
    }
    let start = start.map(|found| found.start);

    interrupt::listen();
    let mut progress = Progress::start(&file.problem.name, arguments.quiet);
    let planned = match search {
        Some((search, method)) => searched(
            &search,
            method,
            &file.problem,
            start.as_ref(),
            &mut progress,
        ),
        None => Planner::new()
            .plan_by(method, &file.problem, start.as_ref(), &mut |event| {
                progress.show(event)
            })
            .map(|plan| (plan, None)),
    };
    progress.finish();
    let (mut plan, optima) =
        planned.map_err(|error| Failure::planning(&file, warm_start, error))?;
    let (judgement, baselines) = parallel::both(
        || plan.judgement(&file.problem),
        || Baselines::of(&file.problem, &plan.discretization),
    );
    if let Some(judgement) = judgement {
        plan.accept(judgement);
    }

    let mut set = FileSet::new();
    let page = match arguments.no_report {
        true => Page::Left,
        false => Page::Made(&baselines),
    };
    let json = add(&file, &plan, page, optima.as_ref(), &folder, &mut set)?;
    match arguments.sample {
        Some(rate) => add_samples(&file, &plan, rate, &folder, &mut set),
        None => set.without(&folder, MOTION),
    }
    let files = set.write()?;
    let summary = || {
        let summary = report::summary(&file.problem, &plan, &baselines, &files);
        match &optima {
            Some(optima) => format!("{summary}\n{}", report::optima(optima)),
            None => summary,
        }
    };
    if arguments.json {
        terminal::print(&json)?;
    }
    match (arguments.quiet, arguments.json) {
        (false, false) => terminal::print(&summary())?,
        (false, true) => terminal::warn(&summary()),
        (true, _) if plan.status != Status::Solved => {
            terminal::warn(&report::verdict(&file.problem, &plan));
        }
        (true, _) => {}
    }
    Ok(plan.status.into())
}

/// The best plan of a search, with all that it found.
fn searched(
    search: &Search,
    method: refine::Method,
    problem: &Problem,
    start: Option<&Start>,
    progress: &mut Progress,
) -> Result<(Plan, Option<Optima>), PlanError> {
    let problem = problem.edited(|problem| problem.mesh.method = method)?;
    let found = search.run(&problem, start, &mut |event| progress.show_search(event))?;
    Ok((found.plan, Some(found.optima)))
}

/// What a user should know of how the files were read.
pub(super) fn say(file: &ProblemFile) {
    for change in &file.repairs {
        terminal::complain(&format!("warning: {change}"));
    }
    for note in &file.notes {
        terminal::complain(&format!("note: {note}"));
    }
}

/// Whether a page is made.
pub(super) enum Page<'a> {
    /// With the motion without planning beside the plan.
    Made(&'a Baselines),
    Left,
}

/// Adds the motion at even times to `set`; where it has none, that is said.
fn add_samples(
    file: &ProblemFile,
    plan: &Plan,
    rate: f64,
    folder: &OutputFolder,
    set: &mut FileSet,
) {
    let table = Samples::of(&file.problem, &plan.discretization, Times::Rate(rate))
        .and_then(|samples| csv(&columns(&samples)));
    match table {
        Ok(table) => set.add(folder, MOTION, &table),
        // Not at the cost of the plan.
        Err(cause) => {
            set.without(folder, MOTION);
            terminal::warn(&format!("warning: no {MOTION}: {cause}"));
        }
    }
}

/// Adds the files of a plan to `set`; the text of `solution.json` is returned.
pub(super) fn add(
    file: &ProblemFile,
    plan: &Plan,
    page: Page<'_>,
    optima: Option<&Optima>,
    folder: &OutputFolder,
    set: &mut FileSet,
) -> Result<String, Failure> {
    let provenance = Provenance::of(file, &plan.linear_solver);
    let mut saved = solution::solution(&file.problem, plan, provenance);
    saved.search = optima.map(solution::search);
    let failure = |message: String| Failure::Format {
        path: file.path.clone(),
        message,
    };
    let json = solution::to_json(&saved).map_err(|error| failure(error.to_string()))?;
    let csv =
        solution::trajectory_csv(&saved.trajectory).map_err(|error| failure(error.to_string()))?;
    set.add(folder, SOLUTION, &json);
    set.add(folder, TRAJECTORY, &csv);
    match page {
        // A trajectory with values that are no numbers has nothing to show.
        Page::Made(baselines) if verify::check(&file.problem, &plan.discretization).is_ok() => {
            let drawing = file.appearance.drawing(&file.robot);
            let motions = (&plan.discretization, baselines);
            let page = report::page(&saved, &file.problem, motions, &drawing);
            set.add(folder, PAGE, &page);
        }
        Page::Made(_) | Page::Left => set.without(folder, PAGE),
    }
    // What was said of an earlier plan.
    set.without(folder, VERIFICATION);
    Ok(json)
}

/// Takes the files of an earlier plan out of `folder`.
pub(super) fn remove(folder: &OutputFolder, set: &mut FileSet) {
    for name in [SOLUTION, TRAJECTORY, PAGE, VERIFICATION, MOTION] {
        set.without(folder, name);
    }
}
