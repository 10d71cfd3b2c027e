//! A saved solution as the start of a new plan.

use super::provenance::fingerprint;
use super::read::{SolutionError, description, discretization, fits, read_solution, untouched};
use super::{Iterate, Provenance, Solution};
use crate::config::ProblemFile;
use crate::dynamics::attitude::{Attitude, SpatialAttitude};
use crate::nlp;
use crate::problem::Problem;
use crate::refine::Start;
use crate::transcription::Discretization;
use std::fmt;
use std::path::{Path, PathBuf};

/// A saved solution as the start of a new plan.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct WarmStart {
    /// Mesh, states, controls and multipliers.
    pub start: Start,
    /// Set where it was planned for another robot file.
    pub other_robot: Option<OtherRobot>,
}

/// A start that was planned for another robot file than that of the problem, with as many joints.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct OtherRobot {
    /// The solution.
    pub solution: PathBuf,
    /// Path of the robot it was planned for, and its SHA-256.
    pub planned_for: [String; 2],
    /// The same of the problem's robot.
    pub robot: [String; 2],
}

impl fmt::Display for OtherRobot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |[path, hash]: &[String; 2]| {
            let short: String = hash.chars().take(8).collect();
            format!("{path} (SHA-256 {short}…)")
        };
        write!(
            f,
            "{}: planned for another robot, {}, than {}; its motion is taken as a start all the \
             same, since its joints are as many",
            self.solution.display(),
            name(&self.planned_for),
            name(&self.robot)
        )
    }
}

/// Reads a `solution.json` as a start for the problem in `file`.
///
/// A base attitude in another description than the problem's is converted; the multipliers, which
/// belong to other variables, are left behind then.
///
/// # Errors
/// [`SolutionError`], a start for a robot with other joints included.
pub fn read_warm_start(path: &Path, file: &ProblemFile) -> Result<WarmStart, SolutionError> {
    warm_start(path, read_solution(path)?, file)
}

/// [`read_warm_start`] of a `solution` that was read or made before; `path` is named in errors.
///
/// # Errors
/// As of [`read_warm_start`].
pub fn warm_start(
    path: &Path,
    solution: Solution,
    file: &ProblemFile,
) -> Result<WarmStart, SolutionError> {
    let problem = &file.problem;
    let trajectory = discretization(path, &solution)?;
    let kept = &solution.provenance;
    untouched(path, kept)?;
    let found = description(path, &solution)?;
    fits(path, &solution, problem, found)?;
    let other_robot = other_robot(path, kept, file);
    let start = match found {
        Some(found) if found != problem.attitude => Start {
            trajectory: converted(&trajectory, found, problem),
            iterate: None,
        },
        _ => Start {
            trajectory,
            iterate: solution.iterate.map(iterate),
        },
    };
    Ok(WarmStart { start, other_robot })
}

/// A word where the robot's text is another.
fn other_robot(path: &Path, kept: &Provenance, file: &ProblemFile) -> Option<OtherRobot> {
    let own = fingerprint(&file.robot.text);
    (kept.robot_sha256 != own).then(|| OtherRobot {
        solution: path.into(),
        planned_for: [kept.robot.path.clone(), kept.robot_sha256.clone()],
        robot: [file.robot.path.clone(), own],
    })
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
