//! `simulate`: a saved plan played on a model of the ground platform.

use super::failure::Failure;
use super::{Outcome, fit, terminal};
use crate::config::PlatformFile;
use crate::dynamics::JointKind;
use crate::report::{FileSet, OutputFolder, Simulation};
use crate::simulate::{Player, SimulateError};
use crate::solution::Saved;
use clap::Args;
use std::path::{Path, PathBuf};

/// Play a saved plan on a model of the ground platform
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Saved solution
    #[arg(value_name = "SOLUTION.json", required_unless_present = "fit")]
    solution: Option<PathBuf>,
    /// Platform file
    #[arg(value_name = "PLATFORM.toml", required_unless_present = "fit")]
    platform: Option<PathBuf>,
    /// Instead of playing a plan, find the platform parameters that explain measurements
    #[arg(long, value_name = "FIT.toml", conflicts_with_all = ["solution", "platform", "repeat", "seed"])]
    fit: Option<PathBuf>,
    /// Folder to write to [default: out/<problem name>/<name of the platform file>, or
    /// out/<name of the fit>]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Runs, instead of the platform file's
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    repeat: Option<u16>,
    /// Seed, instead of the platform file's
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
}

/// Reads, plays, writes, prints.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    match (&arguments.solution, &arguments.platform, &arguments.fit) {
        (Some(solution), Some(platform), _) => play(arguments, solution, platform),
        (_, _, Some(path)) => fit::run(path, arguments.out.as_ref()),
        // The command line was checked for this.
        _ => unreachable!("neither a plan and a platform nor a fit"),
    }
}

fn play(arguments: &Arguments, solution: &Path, platform: &Path) -> Result<Outcome, Failure> {
    let saved = Saved::load(solution)?;
    let problem = &saved.file.problem;
    let failure = |cause: SimulateError| Failure::Simulate {
        path: solution.display().to_string(),
        cause,
    };
    let robot = &problem.robot;
    let mut file = PlatformFile::load(platform, robot)?;
    if let Some(repeats) = arguments.repeat {
        file.platform.repeats = repeats.into();
    }
    if let Some(seed) = arguments.seed {
        file.platform.seed = seed;
    }
    let player = Player::new(problem, &saved.plan, file.platform.clone()).map_err(failure)?;
    let out = match &arguments.out {
        Some(out) => out.clone(),
        None => Path::new("out").join(&problem.name).join(file.folder()?),
    };
    let folder = OutputFolder::create(&out)?;

    let runs = player.runs().map_err(failure)?;
    let simulation = Simulation {
        name: &problem.name,
        solution: solution.display().to_string(),
        platform: &file.platform.name,
        file: (&file.path, &file.text),
        seed: file.platform.seed,
        joints_turn: robot
            .joints()
            .iter()
            .all(|joint| joint.kind == JointKind::Revolute),
        planned: &player.planned(&runs[0].t),
        runs: &runs,
    };
    let format = |message: String| Failure::Format {
        path: solution.display().to_string(),
        message,
    };
    let json = simulation.json().map_err(|e| format(e.to_string()))?;
    let csv = simulation.csv().map_err(|e| format(e.to_string()))?;
    let mut set = FileSet::new();
    set.add(&folder, "simulation.json", &json);
    set.add(&folder, "simulation.csv", &csv);
    set.add_figure(&folder, "simulation", &simulation.figure())?;
    let files = set.write()?;
    terminal::print(&simulation.summary(&files))?;
    Ok(Outcome::Done)
}
