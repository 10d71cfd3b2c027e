//! What a user should know before using a plan, a sentence each.

use crate::dynamics::attitude::SpatialAttitude;
use crate::nlp::{self, ipopt};
use crate::numeric::largest_or_nan;
use crate::problem::Problem;
use crate::refine::{self, CutShort, Method, Outcome, Verdict};
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

/// What may be the reason that a plan has not converged.
pub(super) fn reasons(
    problem: &Problem,
    outcome: &Outcome,
    trajectory: &Trajectory,
) -> Vec<String> {
    let found = [
        unbounded(problem, trajectory),
        too_few_meshes(outcome, &problem.mesh),
    ];
    found.into_iter().flatten().collect()
}

/// Part of the duration within which a joint comes to its largest rate, below which that is a jump.
const JUMP: f64 = 1e-4;

/// A word about joints whose control nothing bounds, or next to nothing: the best may be a jump of their
/// rates, which no mesh resolves.
fn unbounded(problem: &Problem, trajectory: &Trajectory) -> Option<String> {
    let (limits, cost) = (&problem.limits, &problem.cost);
    let duration = trajectory.t.last().copied().unwrap_or(f64::NAN);
    let is_free = |j: usize| {
        let weights = [cost.control[j], cost.torque[j]];
        let torque = limits.torque[j];
        let is_bounded = torque.lower.is_finite() && torque.upper.is_finite();
        let rates = trajectory.joint_velocity.iter().map(|rates| rates[j].abs());
        let most = limits.control[j].upper.max(-limits.control[j].lower);
        let jumps = most.is_infinite() || largest_or_nan(rates) < JUMP * most * duration;
        weights.iter().all(|weight| *weight == 0.0) && !is_bounded && jumps
    };
    let joints = problem.robot.joints().iter().enumerate();
    let free = joints.filter(|(j, _)| is_free(*j));
    let names: Vec<&str> = free.map(|(_, joint)| joint.name.as_str()).collect();
    (!names.is_empty()).then(|| {
        format!(
            "nothing bounds the control of {} closely: the best motion may have rates that jump, and no \
             mesh resolves that; give cost.control a weight, or limits.control or limits.torque \
             tighter bounds",
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
    let last = outcome.records.last().map(|record| record.verdict);
    let failed = match last {
        Some(Verdict::AboveTolerance) => {
            "tried for the sake of the tolerance, did not come nearer to it"
        }
        _ => "tried for the sake of limits between the points, did not converge",
    };
    (count > 0).then(|| {
        format!(
            "{count} finer {meshes}, {failed}; this is the plan before, the time is that of all"
        )
    })
}

/// A word about a number of meshes, or of points, that ended the refinement.
fn too_few_meshes(outcome: &Outcome, settings: &refine::Settings) -> Option<String> {
    let tried = outcome.records.len() + outcome.discarded.len();
    let last = outcome.records.last()?;
    // Of a limit that is exceeded between the points its own warning says so.
    if last.verdict != Verdict::AboveTolerance || outcome.cut_short.is_some() {
        return None;
    }
    let tolerance = settings.tolerance;
    match settings.method {
        Method::Adaptive => {
            let most = settings.max_iterations?;
            (tried >= most).then(|| {
                format!(
                    "mesh.max_iterations = {most} ended the refinement before it had come to the \
                     tolerance {tolerance:e}; leave it out for as many meshes as it takes"
                )
            })
        }
        Method::Global => {
            let most = settings.max_global_points;
            (last.points >= most).then(|| {
                format!(
                    "mesh.max_global_points = {most} ended the refinement before it had come to the \
                     tolerance {tolerance:e}; allow more, or plan with mesh.method = \"a-rpm\""
                )
            })
        }
    }
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
        largest_or_nan(rows.map(|eta| size(eta)))
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
