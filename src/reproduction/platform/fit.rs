//! Which disturbances of the platform explain the measurements.

use crate::config::{FitFile, PlanSource};
use crate::nlp::ipopt::interrupt;
use crate::planner::{Method, PlanError, Status};
use crate::problem::Problem;
use crate::report::FitReport;
use crate::reproduction::{ReproductionError, Session};
use crate::simulate::fit::Experiments;
use crate::simulate::{Player, SimulateError};
use crate::solution::Saved;
use crate::transcription::Discretization;

/// A plan with what it is a plan of, and how it was come by in words.
struct Played {
    problem: Problem,
    plan: Discretization,
    source: String,
}

/// Plans the experiments of `file` and fits its hypotheses, each to all measurements.
///
/// # Errors
/// [`ReproductionError`] where a file it names, a plan or a simulation fails, or it is stopped.
pub fn fit(session: &mut Session<'_>, file: &FitFile) -> Result<FitReport, ReproductionError> {
    let failure = |cause: SimulateError| ReproductionError::Simulate {
        name: file.path.clone(),
        cause,
    };
    let mut platform = None;
    let mut experiments = Vec::new();
    let mut plans = Vec::new();
    for experiment in &file.experiments {
        let name = &experiment.measured.name;
        let Played {
            problem,
            plan,
            source,
        } = played(session, file, name, &experiment.plan)?;
        let on = match &platform {
            Some(platform) => platform,
            None => platform.insert(file.platform(&problem.robot)?.platform),
        };
        let player = Player::new(&problem, &plan, on.clone()).map_err(failure)?;
        experiments.push((player, experiment.measured.clone()));
        plans.push((name.clone(), source));
    }
    let platform = platform.unwrap_or_default();
    let experiments = Experiments::new(experiments, file.scale);
    session.begin(&format!("{}, every hypothesis", file.name))?;
    let unknowns = file.unknowns_by_hypothesis();
    let stop = interrupt::requested;
    let fits = experiments
        .fit_each(&platform, &unknowns, file.starts, &stop)
        .map_err(failure)?;
    session.begin(&file.name)?;
    let unfitted = experiments.compare(&platform).map_err(failure)?;
    let names = file.hypotheses.iter().map(|h| h.name.clone());
    Ok(FitReport {
        name: file.name.clone(),
        file: (file.path.clone(), file.text.clone()),
        plans,
        scale: file.scale,
        unfitted,
        unfitted_residual: fits.first().map_or(0.0, |fit| fit.start_residual),
        fits: names.zip(fits).collect(),
    })
}

/// The plan of an experiment: read, or made.
fn played(
    session: &mut Session<'_>,
    file: &FitFile,
    name: &str,
    source: &PlanSource,
) -> Result<Played, ReproductionError> {
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
            let found = file.problem(path)?;
            let of_file = Method::Collocation(found.problem.mesh.method);
            let method = method.unwrap_or(of_file);
            let title = format!("{name}, {} by {}", found.problem.name, method.name());
            let plan = match session.plan_by(method, &title, &found.problem) {
                Err(ReproductionError::Plan {
                    cause: PlanError::Problem(error),
                    ..
                }) => return Err(found.blame(error).into()),
                plan => plan?,
            };
            let status = match plan.status {
                Status::Infeasible => "beyond its limits",
                status => status.name(),
            };
            Ok(Played {
                source: format!("{} by {}, {status}", found.path, method.name()),
                problem: found.problem,
                plan: plan.discretization,
            })
        }
    }
}
