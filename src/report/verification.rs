//! What `verify` leaves behind: `verification.json` and the lines a person reads.

use super::Lines;
use crate::planner::Status;
use crate::solution;
use crate::solution::{Build, Verification, to_json};
use crate::verify;
use serde::Serialize;
use std::path::{Path, PathBuf};

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    name: &'a str,
    /// Path of the solution, as given.
    solution: String,
    version: &'static str,
    verification: Verification,
}

/// `verification.json` of the solution at `path` for the problem `name`.
///
/// # Errors
/// None that is expected: all keys are strings.
pub fn verification_json(
    name: &str,
    path: &Path,
    found: &verify::Verification,
) -> serde_json::Result<String> {
    to_json(&Document {
        schema: 1,
        name,
        solution: path.display().to_string(),
        version: Build::VERSION,
        verification: solution::verification(found),
    })
}

/// What re-integration found, in degrees and centimetres; `joints_turn` where no joint slides.
pub fn verification_summary(
    name: &str,
    status: Status,
    joints_turn: bool,
    found: &verify::Verification,
    files: &[PathBuf],
) -> String {
    let small = |value: f64, unit: &str| format!("{value:.1e}{unit}");
    let attitude = |angle: f64| small(angle.to_degrees(), "°");
    let length = |length: f64| small(100.0 * length, " cm");
    let joints = if joints_turn {
        attitude(found.max_joint_drift)
    } else {
        small(found.max_joint_drift, " rad or m")
    };
    let mut lines = Lines::default();
    lines.add(
        "under its control",
        format!(
            "base within {} and {}, joints within {joints}",
            attitude(found.max_base_attitude_drift),
            length(found.max_base_position_drift)
        ),
    );
    lines.add(
        "along its path",
        format!(
            "base within {} and {}",
            attitude(found.replay_base_attitude_drift),
            length(found.replay_base_position_drift)
        ),
    );
    lines.add(
        "momentum",
        format!(
            "kept to {} and {}",
            small(found.max_linear_momentum, " kg m/s"),
            small(found.max_angular_momentum, " kg m²/s")
        ),
    );
    lines.add(
        "energy",
        format!(
            "kinetic energy is the joints' work to {}",
            small(found.max_energy_gap, " J")
        ),
    );
    lines.add("steps", found.steps.to_string());
    lines.files(files);
    format!(
        "{name}: planned ({}), the unreduced dynamics integrated again\n\n{}",
        status.words(),
        lines.finish()
    )
}
