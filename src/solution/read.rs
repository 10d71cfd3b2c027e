//! A saved solution, read back: the file, the plan on its mesh, the problem it is a plan for.

use super::provenance::fingerprint;
use super::shape::{self, Misfit};
use super::write::solution;
use super::{Provenance, Solution, Trajectory};
use crate::collocation::{Mesh, MeshError};
use crate::config::{ConfigError, ProblemFile, regular};
use crate::dynamics::attitude::{Attitude, SpatialAttitude};
use crate::planner::{Plan, Status};
use crate::problem::Problem;
use crate::system::with_peaks;
use crate::text::printable::message;
use crate::transcription::Discretization;
use std::path::{Path, PathBuf};

/// Largest solution file, bytes.
const LARGEST: u64 = 256 << 20;

/// A solution file that cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SolutionError {
    /// It cannot be read.
    #[error("{}: cannot be read: {reason}; expected a solution.json", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// It is no solution file.
    #[error("{}: {key}: {message}; expected a solution.json of schema 1", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// Where in it.
        key: String,
        /// What is wrong.
        message: String,
    },
    /// Its mesh cannot be.
    #[error("{}: mesh: {cause}", path.display())]
    Mesh {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        cause: MeshError,
    },
    /// Something in it does not fit the rest of it, or the robot.
    #[error("{}: {key}: {found}; expected {expected}", path.display())]
    Misfit {
        /// The file.
        path: PathBuf,
        /// Where in it.
        key: String,
        /// What stands there.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// The texts of problem and robot in it no longer make a problem.
    #[error("{}: provenance: {}", path.display(), message(cause))]
    Provenance {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        cause: Box<ConfigError>,
    },
}

impl SolutionError {
    /// The file.
    pub fn path(&self) -> &Path {
        match self {
            Self::Unreadable { path, .. }
            | Self::Format { path, .. }
            | Self::Mesh { path, .. }
            | Self::Misfit { path, .. }
            | Self::Provenance { path, .. } => path,
        }
    }

    /// The key in it that it is about, where it is about one.
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::Unreadable { .. } => None,
            Self::Format { key, .. } | Self::Misfit { key, .. } => Some(key),
            Self::Mesh { .. } => Some("mesh"),
            Self::Provenance { .. } => Some("provenance"),
        }
    }
}

/// A saved solution with the problem it is a plan for.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Saved {
    /// The file.
    pub solution: Solution,
    /// The problem, from the texts the file keeps.
    pub file: ProblemFile,
    /// The plan on its mesh.
    pub plan: Discretization,
}

impl Saved {
    /// `plan` for the problem in `file`, as it is saved.
    pub fn planned(file: ProblemFile, plan: Plan) -> Self {
        let provenance = Provenance::of(&file, &plan.linear_solver);
        Self {
            solution: solution(&file.problem, &plan, provenance),
            file,
            plan: plan.discretization,
        }
    }

    /// Reads a `solution.json` with everything in it that was planned, and for what.
    ///
    /// # Errors
    /// [`SolutionError`].
    pub fn load(path: &Path) -> Result<Self, SolutionError> {
        Self::of(path, read_solution(path)?)
    }

    /// What is in `solution`, read before; `path` is named in errors.
    ///
    /// # Errors
    /// [`SolutionError`].
    pub fn of(path: &Path, solution: Solution) -> Result<Self, SolutionError> {
        let plan = discretization(path, &solution)?;
        let kept = &solution.provenance;
        untouched(path, kept)?;
        let file = ProblemFile::restore(
            (&kept.problem.path, &kept.problem.text),
            (&kept.robot.path, &kept.robot.text),
            &kept.problem.overrides,
        )
        .map_err(|error| SolutionError::Provenance {
            path: path.into(),
            cause: Box::new(error),
        })?;
        let (problem, found) = (&file.problem, description(path, &solution)?);
        fits(path, &solution, problem, found)?;
        if let Some(found) = found.filter(|found| *found != problem.attitude) {
            return Err(SolutionError::Misfit {
                path: path.into(),
                key: "trajectory.attitude".into(),
                found: format!("\"{}\"", found.name()),
                expected: format!("\"{}\", as the problem has it", problem.attitude.name()),
            });
        }
        let plan = with_peaks(&file.problem, plan);
        Ok(Self {
            solution,
            file,
            plan,
        })
    }
}

/// Reads a `solution.json`.
///
/// # Errors
/// [`SolutionError`] where it is none, or of another schema.
pub fn read_solution(path: &Path) -> Result<Solution, SolutionError> {
    let unreadable = |reason: String| SolutionError::Unreadable {
        path: path.into(),
        reason,
    };
    let bytes = regular::read(path, LARGEST).map_err(unreadable)?;
    let text = String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8 text".into()))?;
    parse_solution(path, &text)
}

/// Reads the text of a `solution.json`; `path` is named in errors.
///
/// # Errors
/// [`SolutionError`] where it is none, or of another schema.
pub fn parse_solution(path: &Path, text: &str) -> Result<Solution, SolutionError> {
    let format = |key: String, message: String| SolutionError::Format {
        path: path.into(),
        key,
        message,
    };
    // Some editors put a mark of the byte order first.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let solution: Solution =
        serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
            let is_whole = error.path().iter().next().is_none();
            let key = if is_whole {
                "the file".into()
            } else {
                message(error.path())
            };
            format(key, message(error.inner()))
        })?;
    deserializer
        .end()
        .map_err(|error| format("end".into(), message(error)))?;
    if solution.schema != 1 {
        return Err(format("schema".into(), solution.schema.to_string()));
    }
    // null is what is written for a number that is not finite.
    let figures = [
        ("objective", solution.objective),
        ("tolerance", solution.tolerance),
        ("max_error", solution.max_error),
    ];
    match figures.iter().find(|(_, figure)| !figure.is_finite()) {
        Some((key, _)) if solution.status == Status::Solved => Err(format(
            (*key).into(),
            "null, and yet the status is \"solved\"".into(),
        )),
        _ => Ok(solution),
    }
}

/// The plan of `solution` on its mesh; `path` is named in errors.
pub(super) fn discretization(
    path: &Path,
    solution: &Solution,
) -> Result<Discretization, SolutionError> {
    let saved = &solution.mesh;
    let mesh =
        Mesh::new(saved.breakpoints.clone(), &saved.points_per_segment).map_err(|cause| {
            SolutionError::Mesh {
                path: path.into(),
                cause,
            }
        })?;
    shape::check(solution, &mesh).map_err(|misfit| misfit_in(path, misfit))?;
    Ok(on_mesh(mesh, &solution.trajectory))
}

/// The rows of `trajectory`, which fit `mesh`, as the solver has them.
fn on_mesh(mesh: Mesh, trajectory: &Trajectory) -> Discretization {
    let nodes = mesh.points() + 1;
    let (eta, theta) = (&trajectory.base_attitude, &trajectory.joint_position);
    let (rates, u) = (&trajectory.joint_velocity, &trajectory.control);
    let x = (0..nodes)
        .flat_map(|k| [&eta[k], &theta[k], &rates[k]])
        .flatten()
        .copied()
        .collect();
    Discretization {
        duration: trajectory.t[nodes - 1],
        initial_time: 0.0,
        parameters: Vec::new(),
        integrals: Vec::new(),
        states: eta[0].len() + theta[0].len() + rates[0].len(),
        controls: u[0].len(),
        x,
        // The control at t_f is extrapolated, not a variable.
        u: u[..nodes - 1].iter().flatten().copied().collect(),
        mesh,
    }
}

/// Whether the robot's text is the one that was planned for.
pub(super) fn untouched(path: &Path, kept: &Provenance) -> Result<(), SolutionError> {
    if kept.robot_sha256 == fingerprint(&kept.robot.text) {
        return Ok(());
    }
    Err(SolutionError::Format {
        path: path.into(),
        key: "provenance.robot".into(),
        message: "its text is not the one that robot_sha256 belongs to".into(),
    })
}

/// Whether the rows of `solution`, even ones, are those of `problem`'s robot.
pub(super) fn fits(
    path: &Path,
    solution: &Solution,
    problem: &Problem,
    attitude: Option<SpatialAttitude>,
) -> Result<(), SolutionError> {
    shape::check_robot(&solution.trajectory, problem, attitude)
        .map_err(|misfit| misfit_in(path, misfit))
}

fn misfit_in(path: &Path, misfit: Misfit) -> SolutionError {
    let Misfit {
        key,
        found,
        expected,
    } = misfit;
    SolutionError::Misfit {
        path: path.into(),
        key,
        found,
        expected,
    }
}

/// How the base attitude of `solution` is described; `None` for one angle.
pub(super) fn description(
    path: &Path,
    solution: &Solution,
) -> Result<Option<SpatialAttitude>, SolutionError> {
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
