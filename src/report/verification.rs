//! What `verify` leaves behind: `verification.json` and the lines a person reads.

use super::Lines;
use super::format::gap;
use crate::dynamics::JointKind;
use crate::planner::{Doubt, Judgement, Status};
use crate::solution;
use crate::solution::{Build, Saved, Verification, to_json};
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
    /// That of the solution, as saved.
    status: Status,
    /// Whether nothing speaks against it.
    confirmed: bool,
    /// What does.
    doubt: Option<String>,
    verification: Option<Verification>,
}

/// `verification.json` of `saved`, the solution at `path`.
///
/// # Errors
/// None that is expected: all keys are strings.
pub fn verification_json(
    path: &Path,
    saved: &Saved,
    judgement: &Judgement,
) -> serde_json::Result<String> {
    to_json(&Document {
        schema: 1,
        name: &saved.file.problem.name,
        solution: path.display().to_string(),
        version: Build::VERSION,
        status: saved.solution.status,
        confirmed: judgement.doubt.is_none(),
        doubt: judgement.doubt.as_ref().map(Doubt::to_string),
        verification: judgement.verification.as_ref().map(solution::verification),
    })
}

/// That the plan `name`, saved with that status, is not what it says.
pub fn in_doubt(name: &str, status: Status, doubt: &Doubt) -> String {
    let saved = match status {
        Status::Solved => ", though it was saved as solved".into(),
        other => format!(" (saved as {})", other.words()),
    };
    format!("{name}: NOT confirmed{saved}: {doubt}")
}

/// The verdict, and what re-integration found, in degrees and centimetres.
pub fn verification_summary(saved: &Saved, judgement: &Judgement, files: &[PathBuf]) -> String {
    let problem = &saved.file.problem;
    let joints = problem.robot.joints();
    let joints_turn = joints.iter().all(|joint| joint.kind == JointKind::Revolute);
    let mut lines = Lines::default();
    if let Some(found) = &judgement.verification {
        figures(&mut lines, found, joints_turn);
    }
    if let Some(instability) = &judgement.instability {
        lines.add("warning", instability.to_string());
    }
    lines.files(files);
    let status = saved.solution.status;
    let heading = match &judgement.doubt {
        Some(doubt) => in_doubt(&problem.name, status, doubt),
        None => format!(
            "{}: planned ({}), the unreduced dynamics integrated again",
            problem.name,
            status.words()
        ),
    };
    format!("{heading}\n\n{}", lines.finish())
}

/// What re-integration found; `joints_turn` where no joint slides.
fn figures(lines: &mut Lines, found: &verify::Verification, joints_turn: bool) {
    let small = |value: f64, unit: &str| format!("{}{unit}", gap(value));
    let attitude = |angle: f64| small(angle.to_degrees(), "°");
    let length = |length: f64| small(100.0 * length, " cm");
    let joints = if joints_turn {
        attitude(found.max_joint_drift)
    } else {
        small(found.max_joint_drift, " rad or m")
    };
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
}
