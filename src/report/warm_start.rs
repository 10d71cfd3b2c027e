//! A saved solution as the start of a new plan.

use super::{Iterate, Solution, Trajectory};
use crate::collocation::{Mesh, MeshError};
use crate::nlp;
use crate::planner::Start;
use crate::transcription::Discretization;
use std::path::{Path, PathBuf};

/// A solution file that cannot be started from.
#[derive(Debug, thiserror::Error)]
pub enum WarmStartError {
    /// It cannot be read.
    #[error("{}: cannot be read: {source}; expected a solution.json", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
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
    #[error("{}: mesh: {source}", path.display())]
    Mesh {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: MeshError,
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
}

/// Reads a `solution.json` as a start: mesh, states, controls and multipliers.
///
/// # Errors
/// [`WarmStartError`]. Whether it fits a problem is seen when that is planned.
pub fn read_warm_start(path: &Path) -> Result<Start, WarmStartError> {
    let text = std::fs::read_to_string(path).map_err(|source| WarmStartError::Unreadable {
        path: path.into(),
        source,
    })?;
    let format = |key: String, message: String| WarmStartError::Format {
        path: path.into(),
        key,
        message,
    };
    let mut deserializer = serde_json::Deserializer::from_str(&text);
    let solution: Solution = serde_path_to_error::deserialize(&mut deserializer)
        .map_err(|error| format(error.path().to_string(), error.inner().to_string()))?;
    deserializer
        .end()
        .map_err(|error| format("end".into(), error.to_string()))?;
    if solution.schema != 1 {
        return Err(format("schema".into(), solution.schema.to_string()));
    }
    let mesh = Mesh::new(solution.mesh.breakpoints, &solution.mesh.points_per_segment).map_err(
        |source| WarmStartError::Mesh {
            path: path.into(),
            source,
        },
    )?;
    let trajectory = discretization(mesh, &solution.trajectory).map_err(|row| {
        let Misfit {
            key,
            found,
            expected,
        } = row;
        WarmStartError::Rows {
            path: path.into(),
            key,
            found,
            expected,
        }
    })?;
    Ok(Start {
        trajectory,
        iterate: solution.iterate.map(iterate),
    })
}

struct Misfit {
    key: &'static str,
    found: String,
    expected: String,
}

fn discretization(mesh: Mesh, trajectory: &Trajectory) -> Result<Discretization, Misfit> {
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
        duration,
        states: eta[0].len() + theta[0].len() + rates[0].len(),
        controls: u[0].len(),
        x,
        // The control at t_f is extrapolated, not a variable.
        u: u[..nodes - 1].iter().flatten().copied().collect(),
        mesh,
    })
}

fn iterate(saved: Iterate) -> nlp::Iterate {
    nlp::Iterate {
        x: saved.x,
        multipliers: saved.multipliers,
        lower_multipliers: saved.lower_multipliers,
        upper_multipliers: saved.upper_multipliers,
    }
}
