//! A saved solution, read back: the file, the plan on its mesh, the problem it is a plan for.

use super::provenance::fingerprint;
use super::{Solution, Trajectory};
use crate::collocation::{Mesh, MeshError};
use crate::config::{ConfigError, ProblemFile, regular};
use crate::planner::Status;
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
    /// Its rows do not fit its mesh.
    #[error("{}: trajectory.{key}: {found}; expected {expected}", path.display())]
    Rows {
        /// The file.
        path: PathBuf,
        /// The quantity.
        key: &'static str,
        /// What stands there.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// The texts of problem and robot in it no longer make a problem.
    #[error("{}: provenance: {cause}", path.display())]
    Provenance {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        cause: Box<ConfigError>,
    },
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
    /// Reads a `solution.json` with everything in it that was planned, and for what.
    ///
    /// # Errors
    /// [`SolutionError`]. Whether the plan fits the problem is seen when it is used.
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
        if kept.robot_sha256 != fingerprint(&kept.robot.text) {
            return Err(SolutionError::Format {
                path: path.into(),
                key: "provenance.robot".into(),
                message: "its text is not the one that robot_sha256 belongs to".into(),
            });
        }
        let file = ProblemFile::restore(
            (&kept.problem.path, &kept.problem.text),
            (&kept.robot.path, &kept.robot.text),
            &kept.problem.overrides,
        )
        .map_err(|error| SolutionError::Provenance {
            path: path.into(),
            cause: Box::new(error),
        })?;
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
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let solution: Solution = serde_path_to_error::deserialize(&mut deserializer)
        .map_err(|error| format(error.path().to_string(), error.inner().to_string()))?;
    deserializer
        .end()
        .map_err(|error| format("end".into(), error.to_string()))?;
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
    rows(mesh, &solution.trajectory).map_err(|row| {
        let Misfit {
            key,
            found,
            expected,
        } = row;
        SolutionError::Rows {
            path: path.into(),
            key,
            found,
            expected,
        }
    })
}

struct Misfit {
    key: &'static str,
    found: String,
    expected: String,
}

fn rows(mesh: Mesh, trajectory: &Trajectory) -> Result<Discretization, Misfit> {
    let nodes = mesh.points() + 1;
    let columns = [
        ("base_attitude", &trajectory.base_attitude),
        ("joint_position", &trajectory.joint_position),
        ("joint_velocity", &trajectory.joint_velocity),
        ("control", &trajectory.control),
    ];
    if trajectory.t.len() != nodes {
        let found = format!("{} times", trajectory.t.len());
        return Err(Misfit {
            key: "t",
            found,
            expected: format!("{nodes}, one a node of the mesh"),
        });
    }
    for (key, rows) in columns {
        if rows.len() != nodes {
            let found = format!("{} rows", rows.len());
            return Err(Misfit {
                key,
                found,
                expected: format!("{nodes}, one a node of the mesh"),
            });
        }
        let width = rows[0].len();
        if let Some(k) = rows.iter().position(|row| row.len() != width) {
            let found = format!("row {k} has {} values", rows[k].len());
            return Err(Misfit {
                key,
                found,
                expected: format!("{width}, as in row 0"),
            });
        }
    }
    let duration = trajectory.t[nodes - 1];
    if duration <= 0.0 {
        let found = format!("the last time is {duration}");
        return Err(Misfit {
            key: "t",
            found,
            expected: "a duration above zero".into(),
        });
    }
    let [eta, theta, rates, u] = columns.map(|(_, rows)| rows);
    let x = (0..nodes)
        .flat_map(|k| [&eta[k], &theta[k], &rates[k]])
        .flatten()
        .copied()
        .collect();
    Ok(Discretization {
        initial_time: 0.0,
        duration,
        parameters: Vec::new(),
        integrals: Vec::new(),
        states: eta[0].len() + theta[0].len() + rates[0].len(),
        controls: u[0].len(),
        x,
        // The control at t_f is extrapolated, not a variable.
        u: u[..nodes - 1].iter().flatten().copied().collect(),
        mesh,
    })
}
