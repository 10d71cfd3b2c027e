//! Whether a problem can be at all: lengths, signs, start and goal within their limits.

mod checks;
mod cost;
mod ends;
mod goal;
mod keep_out;
mod limits;
mod name;
mod task;
mod way_points;

pub(crate) use keep_out::pair as check_pair;
pub(crate) use name::{EXPECTED as EXPECTED_NAME, is_name};

use super::builder::ProblemBuilder;
use super::error::ProblemError;
use crate::refine::SettingError;
use checks::error;

/// What is wrong with `problem`.
///
/// Lengths and numbers come first, so that later checks may index: the first of these stands alone.
pub(super) fn faults(problem: &ProblemBuilder) -> Vec<ProblemError> {
    if let Err(fault) = content(problem) {
        return vec![fault];
    }
    let mut faults = limits::start(problem);
    faults.extend(ends::within_limits(problem));
    faults.extend(way_points::within_limits(problem));
    if faults.is_empty() {
        faults.extend(ends::move_mass(problem).err());
    }
    faults
}

fn content(problem: &ProblemBuilder) -> Result<(), ProblemError> {
    name::check(&problem.name)?;
    task::check(problem)?;
    limits::check(problem)?;
    keep_out::check(problem)?;
    way_points::check(problem)?;
    cost::check(problem)?;
    mesh(problem)
}

fn mesh(problem: &ProblemBuilder) -> Result<(), ProblemError> {
    let wrong = |SettingError {
                     key,
                     found,
                     expected,
                     ..
                 }| { error(format!("mesh.{key}"), found, expected) };
    problem.mesh.validate().map_err(wrong)
}
