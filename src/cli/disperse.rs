//! `disperse`: a saved plan replayed under perturbations.

use super::failure::Failure;
use super::progress::Progress;
use super::{Outcome, interrupt, terminal};
use crate::config::Dispersion;
use crate::report::{DispersionReport, FileSet, OutputFolder, in_doubt};
use crate::solution::Saved;
use crate::study::dispersion::{DispersionError, MOST_SAMPLES, Replays};
use clap::Args;
use std::path::{Path, PathBuf};

/// Replay a saved plan under perturbed masses, mass centres, inertias, joint errors and momentum
///
/// Prints how the base's largest and final attitude are distributed and which quantities that comes
/// from. Joints follow the plan but for their errors; the base's motion follows by conservation of
/// momentum.
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Saved solution
    #[arg(value_name = "SOLUTION.json")]
    solution: PathBuf,
    /// Replays
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = clap::value_parser!(u64).range(1..=MOST_SAMPLES))]
    samples: u64,
    /// What random numbers begin with
    #[arg(long, value_name = "S", default_value_t = 0)]
    seed: u64,
    /// Distribution of a quantity: body.NAME.mass, .com or .inertia, joint.NAME.offset or .tracking,
    /// momentum.linear or momentum.angular; as normal(mean, sd), uniform(a, b), log_uniform(a, b) or
    /// fixed(x), % of the nominal value; * is every NAME
    #[arg(long, value_name = "KEY=DISTRIBUTION")]
    set: Vec<String>,
    /// Perturb nothing but what --set says
    #[arg(long)]
    only_set: bool,
    /// Folder to write to [default: out/<problem name>-dispersion]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print dispersion.json
    #[arg(long)]
    json: bool,
    /// Print neither progress nor summary
    #[arg(long)]
    quiet: bool,
}

/// Reads, replays, writes, prints.
pub(super) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let path = &arguments.solution;
    let saved = Saved::load(path)?;
    let problem = &saved.file.problem;
    let model = &problem.robot;
    let mut dispersion = match arguments.only_set {
        true => Dispersion::none(model),
        false => Dispersion::usual(model),
    };
    for assignment in &arguments.set {
        dispersion.set(model, assignment)?;
    }
    let default = || Path::new("out").join(format!("{}-dispersion", problem.name));
    let folder = OutputFolder::create(&arguments.out.clone().unwrap_or_else(default))?;
    let failure = |cause: DispersionError| Failure::Disperse {
        path: path.display().to_string(),
        cause,
    };
    let judgement = saved.judge();
    if let Some(doubt) = &judgement.doubt {
        terminal::complain(&in_doubt(&problem.name, saved.solution.status, doubt));
    }
    interrupt::listen();

    let mut progress = Progress::start(&format!("{}: replays", problem.name), arguments.quiet);
    let replayed =
        Replays::new(problem, &saved.plan, &dispersion, arguments.seed).and_then(|replays| {
            let all = arguments.samples;
            let samples = replays.run(all, &mut |done| progress.show_share(done, all))?;
            Ok((replays, samples))
        });
    progress.finish();
    let (replays, samples) = replayed.map_err(failure)?;
    let report = DispersionReport::of(
        (problem, path.display().to_string()),
        (&dispersion, arguments.seed),
        &replays,
        &samples,
    );
    let json = report.json().map_err(|error| Failure::Format {
        path: path.display().to_string(),
        message: error.to_string(),
    })?;
    let mut set = FileSet::new();
    set.add(&folder, "dispersion.json", &json);
    set.add(&folder, "samples.csv", &report.csv());
    set.add(&folder, "dispersion.html", &report.page());
    let files = set.write()?;
    if arguments.json {
        terminal::print(&json)?;
    }
    match (arguments.quiet, arguments.json) {
        (true, _) => {}
        (false, true) => terminal::warn(&report.summary(&files)),
        (false, false) => terminal::print(&report.summary(&files))?,
    }
    Ok(match judgement.doubt {
        Some(_) => Outcome::NotConverged,
        None => Outcome::Done,
    })
}
