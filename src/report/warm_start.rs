//! A saved solution as the start of a new plan.

use super::Iterate;
use super::read::{SolutionError, discretization, read_solution};
use crate::nlp;
use crate::planner::Start;
use std::path::Path;

/// Reads a `solution.json` as a start: mesh, states, controls and multipliers.
///
/// # Errors
/// [`SolutionError`]. Whether it fits a problem is seen when that is planned.
pub fn read_warm_start(path: &Path) -> Result<Start, SolutionError> {
    let solution = read_solution(path)?;
    Ok(Start {
        trajectory: discretization(path, &solution)?,
        iterate: solution.iterate.map(iterate),
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
