//! What was solved by what, enough to do it again.

use super::Build;
use crate::config::ProblemFile;
use crate::nlp::{LinearSolver, ipopt};
use serde::{Deserialize, Deserializer, Serialize};
use sha2::{Digest, Sha256};

/// What was solved by what.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Provenance {
    /// Version of this program with its git revision.
    pub version: String,
    /// Version of Ipopt.
    pub ipopt: String,
    /// Linear solver inside Ipopt, as of [`crate::planner::Plan::linear_solver`].
    #[serde(deserialize_with = "current_names")]
    pub linear_solver: String,
    /// SHA-256 of the robot's text in UTF-8, hexadecimal.
    pub robot_sha256: String,
    /// The problem.
    pub problem: ProblemSource,
    /// The robot.
    pub robot: TextFile,
    /// What was changed of the robot before it was planned for, a line each; reading the texts
    /// again changes it again.
    #[serde(default)]
    pub repairs: Vec<String>,
}

/// The problem file and what was laid over it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct ProblemSource {
    /// Path, as given.
    pub path: String,
    /// The whole file.
    pub text: String,
    /// Options of the command line that changed it, in order.
    pub overrides: Vec<String>,
}

/// A file by its path and text.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct TextFile {
    /// Path, as found from the problem file.
    pub path: String,
    /// The whole file.
    pub text: String,
}

impl Provenance {
    /// Of a plan by `linear_solver` for the problem in `file`.
    pub fn of(file: &ProblemFile, linear_solver: &str) -> Self {
        Self {
            version: Build::VERSION.into(),
            ipopt: ipopt::version().into(),
            linear_solver: linear_solver.into(),
            robot_sha256: fingerprint(&file.robot.text),
            problem: ProblemSource {
                path: file.path.clone(),
                text: file.text.clone(),
                overrides: file.overrides.clone(),
            },
            robot: TextFile {
                path: file.robot.path.clone(),
                text: file.robot.text.clone(),
            },
            repairs: file.repairs.clone(),
        }
    }
}

/// Names of linear solvers, of which earlier files have an older one.
fn current_names<'de, D: Deserializer<'de>>(names: D) -> Result<String, D::Error> {
    String::deserialize(names).map(|names| LinearSolver::current_names(&names))
}

/// SHA-256 of a text, hexadecimal.
pub(super) fn fingerprint(text: &str) -> String {
    let digest = Sha256::digest(text.as_bytes());
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}
