//! A saved solution as the start of a new plan.

use super::read::{SolutionError, discretization, read_solution};
use super::{Iterate, Solution};
use crate::dynamics::attitude::{Attitude, SpatialAttitude};
use crate::nlp;
use crate::problem::Problem;
use crate::refine::Start;
use crate::transcription::Discretization;
use std::path::Path;

/// Reads a `solution.json` as a start for `problem`: mesh, states, controls and multipliers.
///
/// A base attitude in another description than the problem's is converted; the multipliers, which
/// belong to other variables, are left behind then.
///
/// # Errors
/// [`SolutionError`]. Whether it fits the problem otherwise is seen when that is planned.
pub fn read_warm_start(path: &Path, problem: &Problem) -> Result<Start, SolutionError> {
    let solution = read_solution(path)?;
    let trajectory = discretization(path, &solution)?;
    match description(path, &solution)? {
        Some(found) if problem.robot.plane().is_none() && found != problem.attitude => Ok(Start {
            trajectory: converted(&trajectory, found, problem),
            iterate: None,
        }),
        _ => Ok(Start {
            trajectory,
            iterate: solution.iterate.map(iterate),
        }),
    }
}

/// How the base attitude of `solution` is described; `None` for one angle.
fn description(path: &Path, solution: &Solution) -> Result<Option<SpatialAttitude>, SolutionError> {
    let error = |key: &str, message: String| SolutionError::Format {
        path: path.into(),
        key: key.into(),
        message,
    };
    let name = solution.trajectory.attitude.as_str();
    let width = solution
        .trajectory
        .base_attitude
        .first()
        .map_or(0, Vec::len);
    let (found, expected) = match name {
        "angle" => (None, 1),
        // Files that do not say.
        "" if width == 3 => (Some(SpatialAttitude::RollPitchYaw), 3),
        "" => (None, 1),
        name => {
            let found = SpatialAttitude::ALL.into_iter().find(|a| a.name() == name);
            let found = found.ok_or_else(|| error("trajectory.attitude", format!("{name:?}")))?;
            (Some(found), found.count())
        }
    };
    if width == expected {
        return Ok(found);
    }
    let message = format!("{width} values a row do not make an attitude, {expected} do");
    Err(error("trajectory.base_attitude", message))
}

/// `trajectory` with its base attitude described as in `problem` instead of by `from`.
fn converted(
    trajectory: &Discretization,
    from: SpatialAttitude,
    problem: &Problem,
) -> Discretization {
    let to = problem.attitude;
    let mut eta = to.of_angles(&problem.task.initial_base_attitude);
    let mut x = Vec::new();
    for row in trajectory.x.chunks_exact(trajectory.states) {
        let (old, joints) = row.split_at(from.count());
        eta = to.of_quaternion(&from.to_quaternion(old), &eta);
        x.extend(eta.iter().chain(joints));
    }
    Discretization {
        states: trajectory.states - from.count() + to.count(),
        x,
        ..trajectory.clone()
    }
}

fn iterate(saved: Iterate) -> nlp::Iterate {
    nlp::Iterate {
        x: saved.x,
        multipliers: saved.multipliers,
        lower_multipliers: saved.lower_multipliers,
        upper_multipliers: saved.upper_multipliers,
    }
}
