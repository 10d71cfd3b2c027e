//! `compare`: one task by every planner.

use super::compare_figure::figure;
use super::compare_report::{self, Row};
use super::failure::Failure;
use super::progress::Progress;
use super::{Outcome, interrupt, plan, terminal};
use crate::config::{Overrides, ProblemFile};
use crate::nlp::ipopt::interrupt as stop;
use crate::planner::{Method, Plan, PlanError, Planner, Problem, Status};
use crate::refine;
use crate::report::OutputFolder;
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
    /// Print the comparison as one JSON document
    #[arg(long)]
    json: bool,
}

/// What one planner made of the task.
#[derive(Debug)]
pub(super) struct Entry {
    /// The planner.
    pub method: Method,
    /// Its plan, or why it is not made for the task.
    pub plan: Result<Plan, String>,
}

/// Plans, writes, prints.
///
/// The exit status is that of A-RPM, the planner of this program.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let mut overrides = Overrides::default();
    for assignment in &arguments.set {
        overrides.set(assignment)?;
    }
    let file = ProblemFile::load(&arguments.problem, &overrides)?;
    let default = || Path::new("out").join(format!("{}-compare", file.problem.name));
    let path = arguments.out.clone().unwrap_or_else(default);
    let folder = OutputFolder::create(&path)?;
    interrupt::listen();

    let mut entries: Vec<Entry> = Vec::new();
    let mut notes = Vec::new();
    let mut problem = file.problem.clone();
    for method in Method::ALL {
        if entries.len() == 1 && problem.task.end_effector.is_some() {
            notes.extend(in_joint_space(&mut problem, &entries[0]));
        }
        let task = if method.optimises() {
            &file.problem
        } else {
            &problem
        };
        entries.push(Entry {
            method,
            plan: by(method, &file, task)?,
        });
        if stop::requested() {
            break;
        }
    }
    let mut files = write(&path, &file, &entries)?;
    let rows: Vec<Row> = entries.iter().map(Row::of).collect();
    let text = compare_report::markdown(&file.problem.name, &rows, &notes);
    let json = compare_report::json(&file.problem.name, &rows, &notes)?;
    files.push(folder.write("compare.md", &text)?);
    files.push(folder.write("compare.csv", &compare_report::csv(&rows)?)?);
    files.push(folder.write("compare.json", &json)?);
    let drawn: Vec<&Entry> = entries.iter().filter(|entry| entry.plan.is_ok()).collect();
    files.extend(folder.write_figure("compare", &figure(&file.problem, &drawn))?);
    if arguments.json {
        terminal::print(&json)?;
        terminal::warn(&text);
    } else {
        let list: String = files
            .iter()
            .map(|f| format!("written {}\n", f.display()))
            .collect();
        terminal::print(&format!("{text}\n{list}"))?;
    }
    Ok(outcome(&entries))
}

fn outcome(entries: &[Entry]) -> Outcome {
    if stop::requested() {
        return Outcome::Interrupted;
    }
    match entries.first().and_then(|first| first.plan.as_ref().ok()) {
        Some(plan) => match plan.status {
            Status::Solved => Outcome::Done,
            Status::Infeasible => Outcome::Infeasible,
            Status::NotConverged => Outcome::NotConverged,
            Status::Interrupted => Outcome::Interrupted,
        },
        None => Outcome::NotConverged,
    }
}

/// The plan by one method; a task it is not made for is told, not failed on.
fn by(
    method: Method,
    file: &ProblemFile,
    problem: &Problem,
) -> Result<Result<Plan, String>, Failure> {
    let title = format!("{}, {}", problem.name, method.name());
    let mut progress = Progress::start(&title, false);
    let planned = Planner::new().plan_by(method, problem, None, &mut |event| progress.show(event));
    progress.finish();
    match planned {
        Ok(plan) => Ok(Ok(plan)),
        Err(PlanError::Problem(error)) if !method.optimises() => Ok(Err(error.to_string())),
        Err(error) => Err(Failure::planning(file, None, error)),
    }
}

/// Gives the planners that know joint goals alone the joint positions at which A-RPM ended; says
/// so, or why that cannot be.
fn in_joint_space(problem: &mut Problem, adaptive: &Entry) -> Option<String> {
    let plan = adaptive.plan.as_ref().ok()?;
    if plan.status != Status::Solved {
        return None;
    }
    problem.task.final_joints = plan.trajectory.joint_position.last()?.clone();
    problem.task.free_joints.fill(false);
    problem.task.end_effector = None;
    Some(format!(
        "The task is a goal for the end effector. Planners in joint space were given the joint \
         positions at which {} ends; with another base motion they leave the end effector \
         elsewhere.",
        Method::Collocation(refine::Method::Adaptive).name()
    ))
}

/// Every plan in a folder of its method.
fn write(path: &Path, file: &ProblemFile, entries: &[Entry]) -> Result<Vec<PathBuf>, Failure> {
    let mut files = Vec::new();
    for entry in entries {
        if let Ok(found) = &entry.plan {
            let own = OutputFolder::create(&path.join(entry.method.name()))?;
            files.extend(plan::write(file, found, None, &own)?.1);
        }
    }
    Ok(files)
}
