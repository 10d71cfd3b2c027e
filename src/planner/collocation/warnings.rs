//! What a user should know before using a plan, a sentence each.

use crate::dynamics::attitude::SpatialAttitude;
use crate::largest::largest;
use crate::nlp::{self, ipopt};
use crate::ocp::Interval;
use crate::problem::Problem;
use crate::refine::{CutShort, Outcome};
use crate::system::Trajectory;

/// The warnings about a trajectory, and about how it was found.
pub(super) fn warnings(
    trajectory: &Trajectory,
    outcome: &Outcome,
    solver: &nlp::Settings,
) -> Vec<String> {
    let found = [
        near_singularity(trajectory),
        ipopt::why_not_multifrontal(solver),
        outcome.statistics.fallback_warning(),
        discarded(outcome),
    ];
    found.into_iter().flatten().collect()
}

/// A word about joints whose control nothing bounds: the best may be a jump of their rates, which no
/// mesh resolves.
pub(super) fn unbounded(problem: &Problem) -> Option<String> {
    let (limits, cost) = (&problem.limits, &problem.cost);
    let joints = problem.robot.joints().iter().enumerate();
    let free = joints.filter(|(j, _)| {
        let ranges = [limits.control[*j], limits.torque[*j]];
        let is_bounded = |range: &Interval| range.lower.is_finite() && range.upper.is_finite();
        let weights = [cost.control[*j], cost.torque[*j]];
        !ranges.iter().any(is_bounded) && weights.iter().all(|weight| *weight == 0.0)
    });
    let names: Vec<&str> = free.map(|(_, joint)| joint.name.as_str()).collect();
    (!names.is_empty()).then(|| {
        format!(
            "nothing bounds the control of {}: the best motion may have rates that jump, and no mesh \
             resolves that; give cost.control a weight, or limits.control or limits.torque bounds",
            names.join(", ")
        )
    })
}

/// A word about meshes that were tried for nothing.
fn discarded(outcome: &Outcome) -> Option<String> {
    let count = outcome.discarded.len();
    let meshes = if count == 1 { "mesh" } else { "meshes" };
    let of_mesh = if count > 0 {
        ", of the last mesh that was solved"
    } else {
        ""
    };
    match outcome.cut_short {
        Some(CutShort::OutOfTime) => {
            return Some(format!(
                "the time limit ended the planning; this is the best trajectory until then{of_mesh}"
            ));
        }
        // The status says it.
        Some(_) => return None,
        None => {}
    }
    (count > 0).then(|| {
        format!(
            "{count} finer {meshes}, tried for the sake of limits between the points, did not \
             converge; this is the plan before, the time is that of all"
        )
    })
}

/// Base pitch beyond which roll-pitch-yaw rates are more than ten times the base's own, rad.
const STEEP: f64 = 1.47;
/// Length of modified Rodrigues parameters beyond which their rates are more than ten times those
/// of a base that has not turned; 286°.
const LONG: f64 = 3.0;

/// A word about the description of the attitude where the base comes close to its singularity.
fn near_singularity(trajectory: &Trajectory) -> Option<String> {
    let most = |size: fn(&[f64]) -> f64| {
        let rows = trajectory.base_attitude.iter();
        largest(rows.map(|eta| size(eta)))
    };
    match trajectory.attitude? {
        SpatialAttitude::RollPitchYaw => {
            let steepest = most(|eta| eta[1].abs());
            (steepest > STEEP).then(|| {
                format!(
                    "the base pitches to {:.1}°, and roll-pitch-yaw is singular at 90°: roll and \
                     yaw there are not to be relied on, nor may a failure to converge say \
                     anything about the task; plan with base.attitude = \"quaternion\" or \"mrp\"",
                    steepest.to_degrees()
                )
            })
        }
        SpatialAttitude::Quaternion => None,
        SpatialAttitude::Mrp => {
            let longest = most(|eta| eta.iter().map(|s| s * s).sum::<f64>().sqrt());
            (longest > LONG).then(|| {
                format!(
                    "the base turns by {:.1}°, and modified Rodrigues parameters are singular at \
                     360°: a failure to converge may say nothing about the task; plan with \
                     base.attitude = \"quaternion\"",
                    (4.0 * longest.atan()).to_degrees()
                )
            })
        }
    }
}
