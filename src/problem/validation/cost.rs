//! Weights of the cost.

use super::checks::{Checked, count, error, indexed, number, weight};
use crate::problem::builder::ProblemBuilder;
use crate::problem::components::{ComponentKind, base_sizes};
use crate::problem::cost::CostId;
use crate::problem::magnitude;

pub(super) fn check(problem: &ProblemBuilder) -> Checked {
    every_weight(problem)?;
    weight(CostId::Duration.key(), problem.cost.duration)?;
    rate_matrix(problem)
}

fn every_weight(problem: &ProblemBuilder) -> Checked {
    for entry in problem.cost.entries() {
        let key = entry.id.key();
        let expected = problem.component_count(entry.components);
        let what = match entry.components {
            ComponentKind::Joint => "joints",
            ComponentKind::BaseAttitude | ComponentKind::BaseRate => "base angles",
            ComponentKind::BasePosition => "base lengths",
            ComponentKind::Base => "bases",
        };
        count(key, entry.weights.len(), expected, what)?;
        for (i, &value) in entry.weights.iter().enumerate() {
            weight(indexed(key, i, expected), value)?;
        }
    }
    Ok(())
}

/// Square, finite and symmetric.
fn rate_matrix(problem: &ProblemBuilder) -> Checked {
    let Some(matrix) = &problem.cost.rate_matrix else {
        return Ok(());
    };
    let key = CostId::RateMatrix.key();
    let size = base_sizes(&problem.robot).0 + problem.robot.joint_count();
    let rows = "rows, one a base angle and joint";
    count(key, matrix.len(), size, rows)?;
    for (i, row) in matrix.iter().enumerate() {
        count(&format!("{key}[{i}]"), row.len(), size, "columns")?;
        for (j, value) in row.iter().enumerate() {
            let key = || format!("{key}[{i}][{j}]");
            number(&key(), *value, magnitude::WEIGHT)?;
            if matrix[j].get(i).is_some_and(|mirror| mirror != value) {
                return Err(error(key(), value, "a symmetric matrix"));
            }
        }
    }
    Ok(())
}
