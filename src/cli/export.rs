//! `export`: a saved plan for other tools.

use super::failure::Failure;
use super::sample::MOTION;
use super::{Outcome, terminal};
use crate::planner::Status;
use crate::report::{FileSet, Lines, OutputFolder};
use crate::solution::Saved;
use crate::solution::export::{
    ExportError, PLAYER, Samples, Times, columns, csv, follow_joint_trajectory, joint_trajectory,
    mjcf, parquet,
};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Into how many parts the time between two nodes is divided for a simulation, which is to follow the
/// polynomials and not the lines between nodes.
const PARTS: usize = 4;

/// Write a saved plan for other tools: spreadsheets, data frames, ROS 2, MuJoCo
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Saved solution
    #[arg(value_name = "SOLUTION.json")]
    solution: PathBuf,
    /// Which tools
    #[arg(long)]
    format: Format,
    /// Rows a second, instead of the nodes of the plan
    #[arg(long, value_name = "HZ", allow_negative_numbers = true)]
    rate: Option<f64>,
    /// Torques in messages of ROS 2 too, for controllers that command efforts; others refuse them
    #[arg(long)]
    effort: bool,
    /// Folder to write to [default: that of the solution]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// What is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// motion.csv: a row a time, columns with names and units
    Csv,
    /// motion.parquet: the same columns for data frames
    Parquet,
    /// joint_trajectory.yaml, a message of ROS 2, and follow_joint_trajectory.yaml, a goal with it
    JointTrajectory,
    /// mujoco/: a model with the motion as keyframes, and a program in Python that plays it
    Mujoco,
}

/// Reads, samples, writes.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let path = &arguments.solution;
    if arguments.effort && arguments.format != Format::JointTrajectory {
        let message = "--effort: expected with --format joint-trajectory alone";
        return Err(Failure::Usage(message.into()));
    }
    let saved = read(path)?;
    let samples = samples(arguments, &saved)?;
    let folder = match &arguments.out {
        Some(out) => out.clone(),
        None => match path.parent() {
            Some(parent) if parent != Path::new("") => parent.to_path_buf(),
            _ => ".".into(),
        },
    };
    let mut files = FileSet::new();
    match arguments.format {
        Format::Csv => {
            let folder = OutputFolder::create(&folder)?;
            let text = csv(&columns(&samples)).map_err(failed(path))?;
            files.add(&folder, MOTION, &text);
        }
        Format::Parquet => {
            let folder = OutputFolder::create(&folder)?;
            let bytes = parquet(&columns(&samples), &saved.solution).map_err(failed(path))?;
            files.add_bytes(&folder, "motion.parquet", bytes);
        }
        Format::JointTrajectory => {
            let folder = OutputFolder::create(&folder)?;
            files.add(
                &folder,
                "joint_trajectory.yaml",
                &joint_trajectory(&samples, arguments.effort),
            );
            let goal = follow_joint_trajectory(&samples, arguments.effort);
            files.add(&folder, "follow_joint_trajectory.yaml", &goal);
        }
        Format::Mujoco => {
            let folder = OutputFolder::create(&folder.join("mujoco"))?;
            let text = csv(&columns(&samples)).map_err(failed(path))?;
            files.add(
                &folder,
                "model.xml",
                &mjcf(&saved.file.problem.robot, &samples),
            );
            files.add(&folder, MOTION, &text);
            files.add(&folder, "play.py", PLAYER);
        }
    }
    let mut lines = Lines::default();
    lines.add("rows", samples.t.len().to_string());
    lines.files(&files.write()?);
    terminal::print(&format!("{}\n\n{}", saved.solution.name, lines.finish()))?;
    Ok(saved.solution.status.into())
}

fn samples(arguments: &Arguments, saved: &Saved) -> Result<Samples, Failure> {
    let times = match (arguments.rate, arguments.format) {
        (Some(rate), _) => Times::Rate(rate),
        (None, Format::Mujoco) => Times::Divided(PARTS),
        (None, _) => Times::Nodes,
    };
    Samples::of(&saved.file.problem, &saved.plan, times).map_err(|cause| {
        match (cause, arguments.rate) {
            (ExportError::Rate(cause), Some(rate)) => {
                Failure::Usage(format!("--rate {rate:?}: {cause}"))
            }
            (cause, _) => failed(&arguments.solution)(cause),
        }
    })
}

/// A saved plan, with a word where it is not solved.
pub(super) fn read(path: &Path) -> Result<Saved, Failure> {
    let saved = Saved::load(path)?;
    let status = saved.solution.status;
    if status != Status::Solved {
        terminal::warn(&format!(
            "warning: {}: the plan is {}, do not fly it",
            path.display(),
            status.words()
        ));
    }
    Ok(saved)
}

/// What keeps the plan at `path` from being exported.
pub(super) fn failed(path: &Path) -> impl Fn(ExportError) -> Failure {
    move |cause| Failure::Usage(format!("{}: {cause}", path.display()))
}
