//! Sizes of a problem, by which weights are measured.

use super::metrics::base_angles;
use super::straight_line::straight_motion;
use crate::numeric::largest_or_nan;
use crate::problem::{Problem, Sizes};

/// Steps along the straight path at which the base angle is looked at.
const STEPS: usize = 100;

/// Sizes of the straight joint path of `problem`'s task.
pub fn sizes(problem: &Problem) -> Sizes {
    let task = &problem.task;
    let duration = task.duration.typical();
    let motion = straight_motion(problem, duration, STEPS);
    let ends = task.initial_joints.iter().zip(&task.final_joints);
    let squared_travel = ends.map(|(a, b)| (b - a).powi(2)).sum();
    Sizes::new(
        duration,
        largest_or_nan(base_angles(&motion)),
        squared_travel,
    )
}
