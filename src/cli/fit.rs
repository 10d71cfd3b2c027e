//! `simulate --fit`: platform parameters from published measurements.

use super::failure::Failure;
use super::progress::Progress;
use super::{Outcome, interrupt, terminal};
use crate::config::{FitFile, Overrides, PlanSource, PlatformFile, ProblemFile};
use crate::nlp::ipopt::interrupt as stop;
use crate::planner::{Method, Planner, Problem};
use crate::report::{FitReport, OutputFolder, Saved};
use crate::simulate::fit::{Experiments, Fit};
use crate::simulate::{Platform, Player, SimulateError};
use crate::transcription::Discretization;
use std::path::{Path, PathBuf};

/// A plan with what it is a plan of, and how it was come by in words.
struct Played {
    problem: Problem,
    plan: Discretization,
    source: String,
}

/// Reads, plans, fits, writes, prints.
pub(super) fn run(path: &Path, out: Option<&PathBuf>) -> Result<Outcome, Failure> {
    let file = FitFile::load(path)?;
    let folder = Path::new("out").join(&file.name);
    let folder = OutputFolder::create(out.unwrap_or(&folder))?;
    interrupt::listen();

    let mut platform: Option<Platform> = None;
    let mut experiments = Vec::new();
    let mut plans = Vec::new();
    for experiment in &file.experiments {
        let name = &experiment.measured.name;
        let Played {
            problem,
            plan,
            source,
        } = played(name, &experiment.plan)?;
        if platform.is_none() {
            platform = Some(PlatformFile::load(&file.platform, &problem.robot)?.platform);
        }
        let on = platform.clone().unwrap_or_default();
        let player = Player::new(&problem, &plan, on).map_err(|e| failure(&file, e))?;
        experiments.push((player, experiment.measured.clone()));
        plans.push((name.clone(), source));
        if stop::requested() {
            return Ok(Outcome::Interrupted);
        }
    }
    let platform = platform.unwrap_or_default();
    let experiments = Experiments::new(experiments, file.scale);
    let Some(fits) = fit_all(&file, &experiments, &platform)? else {
        return Ok(Outcome::Interrupted);
    };
    let unfitted = experiments
        .compare(&platform)
        .map_err(|e| failure(&file, e))?;
    let report = FitReport {
        name: &file.name,
        file: (&file.path, &file.text),
        plans: &plans,
        scale: file.scale,
        unfitted: &unfitted,
        unfitted_residual: fits.first().map_or(0.0, |(_, fit)| fit.start_residual),
        fits: &fits,
    };
    let json = report.json().map_err(|error| Failure::Format {
        path: file.path.clone(),
        message: error.to_string(),
    })?;
    let files = [
        folder.write("fit.md", &report.markdown())?,
        folder.write("fit.json", &json)?,
    ];
    terminal::print(&report.summary(&files))?;
    Ok(Outcome::Done)
}

/// Every hypothesis, several at a time; none where it was interrupted.
fn fit_all(
    file: &FitFile,
    experiments: &Experiments,
    platform: &Platform,
) -> Result<Option<Vec<(String, Fit)>>, Failure> {
    let progress = Progress::start(&file.name, false);
    let fit = |hypothesis: usize| {
        let hypothesis = &file.hypotheses[hypothesis];
        let unknowns: Vec<_> = hypothesis
            .unknowns
            .iter()
            .map(|&u| file.unknowns[u].clone())
            .collect();
        let fit = experiments.fit(platform, &unknowns, file.starts, &stop::requested)?;
        Ok((hypothesis.name.clone(), fit))
    };
    let fits: Vec<Result<_, SimulateError>> =
        super::parallel::in_order(file.hypotheses.len(), &fit);
    progress.finish();
    if stop::requested() {
        return Ok(None);
    }
    fits.into_iter()
        .collect::<Result<Vec<_>, _>>()
        .map(Some)
        .map_err(|error| failure(file, error))
}

fn failure(file: &FitFile, source: SimulateError) -> Failure {
    Failure::Simulate {
        path: file.path.clone(),
        source,
    }
}

/// The plan of an experiment: read, or made.
fn played(name: &str, source: &PlanSource) -> Result<Played, Failure> {
    match source {
        PlanSource::Solution(path) => {
            let saved = Saved::load(path)?;
            Ok(Played {
                source: format!("{} ({})", path.display(), saved.solution.method),
                problem: saved.file.problem,
                plan: saved.plan,
            })
        }
        PlanSource::Problem(path, method) => {
            let file = ProblemFile::load(path, &Overrides::default())?;
            let of_file = Method::Collocation(file.problem.mesh.method);
            let method = method.unwrap_or(of_file);
            let title = format!("{name}, {} by {}", file.problem.name, method.name());
            let mut progress = Progress::start(&title, false);
            let plan = Planner::new().plan_by(method, &file.problem, None, &mut |event| {
                progress.show(event)
            });
            progress.finish();
            let plan = plan.map_err(|error| Failure::planning(&file, None, error))?;
            Ok(Played {
                source: format!(
                    "{} by {}, {}",
                    path.display(),
                    method.name(),
                    plan.status.name()
                ),
                problem: file.problem,
                plan: plan.discretization,
            })
        }
    }
}
