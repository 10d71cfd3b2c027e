//! `simulate`: a saved plan played on a model of the ground platform.

use super::failure::Failure;
use super::{Outcome, terminal};
use crate::config::PlatformFile;
use crate::dynamics::JointKind;
use crate::report::{OutputFolder, Saved, Simulation};
use crate::simulate::{Player, Run, SimulateError};
use clap::Args;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Play a saved plan on a model of the ground platform
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Saved solution
    #[arg(value_name = "SOLUTION.json")]
    solution: PathBuf,
    /// Platform file
    #[arg(value_name = "PLATFORM.toml")]
    platform: PathBuf,
    /// Folder to write to [default: out/<problem name>/<name of the platform file>]
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
    let saved = Saved::load(&arguments.solution)?;
    let problem = &saved.file.problem;
    let failure = |source: SimulateError| Failure::Simulate {
        path: arguments.solution.display().to_string(),
        source,
    };
    let robot = &problem.robot;
    let mut file = PlatformFile::load(&arguments.platform, robot)?;
    if let Some(repeats) = arguments.repeat {
        file.platform.repeats = repeats.into();
    }
    if let Some(seed) = arguments.seed {
        file.platform.seed = seed;
    }
    let player = Player::new(problem, &saved.plan, file.platform.clone()).map_err(failure)?;
    let default = || {
        let platform = arguments.platform.file_stem().unwrap_or_default();
        Path::new("out").join(&problem.name).join(platform)
    };
    let folder = OutputFolder::create(&arguments.out.clone().unwrap_or_else(default))?;

    let runs = play(&player).map_err(failure)?;
    let simulation = Simulation {
        name: &problem.name,
        solution: arguments.solution.display().to_string(),
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
        path: arguments.solution.display().to_string(),
        message,
    };
    let json = simulation.json().map_err(|e| format(e.to_string()))?;
    let csv = simulation.csv().map_err(|e| format(e.to_string()))?;
    let files = [
        folder.write("simulation.json", &json)?,
        folder.write("simulation.csv", &csv)?,
    ];
    terminal::print(&simulation.summary(&files))?;
    Ok(Outcome::Done)
}

/// All runs in order, several at a time: each has random numbers of its own.
fn play(player: &Player) -> Result<Vec<Run>, SimulateError> {
    let count = player.platform().repeats;
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= count {
                return done;
            }
            done.push((index, player.run(index)));
        }
    };
    let mut runs: Vec<_> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..workers.min(count)).map(|_| scope.spawn(work)).collect();
        workers
            .into_iter()
            .flat_map(|worker| {
                worker
                    .join()
                    .unwrap_or_else(|p| std::panic::resume_unwind(p))
            })
            .collect()
    });
    runs.sort_by_key(|(index, _)| *index);
    runs.into_iter().map(|(_, run)| run).collect()
}
