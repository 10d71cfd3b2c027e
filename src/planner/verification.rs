//! Verification as a step of planning: a plan that does not hold what it says is not solved.

use super::{Plan, Status};
use crate::dynamics::JointKind;
use crate::largest::largest;
use crate::problem::Problem;
use crate::verify::{Verification, verify};

/// Part of the largest joint travel by which a re-integrated motion may drift from the plan.
const DRIFT: f64 = 1e-2;
/// Part of the tightest limit on the base attitude by which the base may drift.
const OF_LIMIT: f64 = 0.1;
/// Drift of the base that counts for nothing, rad.
const NEGLIGIBLE: f64 = 1e-3;

impl Plan {
    /// The plan, which counts as not converged where a figure of it is not a finite number: such a
    /// plan is no result, whatever its planner made of it.
    pub(super) fn judged_finite(mut self) -> Self {
        let Some(what) = self.not_finite() else {
            return self;
        };
        if matches!(self.status, Status::Solved | Status::Infeasible) {
            self.status = Status::NotConverged;
            self.diagnosis = None;
            self.warnings.push(format!(
                "{what} is not a finite number: the figures of the robot and the task are too far \
                 apart in size to be planned with"
            ));
        }
        self
    }

    /// The first thing in the plan that is not finite.
    fn not_finite(&self) -> Option<&'static str> {
        let (motion, found) = (&self.trajectory, &self.metrics);
        let rows = |rows: &[Vec<f64>]| rows.iter().flatten().all(|value| value.is_finite());
        let all = |values: &[f64]| values.iter().all(|value| value.is_finite());
        let goals = self
            .goals
            .iter()
            .flat_map(|goal| [goal.distance, goal.angle]);
        [
            ("the duration", all(&motion.t)),
            ("the base attitude", rows(&motion.base_attitude)),
            ("the base position", rows(&motion.base_position)),
            ("a base rate", rows(&motion.base_rate)),
            ("a joint position", rows(&motion.joint_position)),
            ("a joint rate", rows(&motion.joint_velocity)),
            ("a control", rows(&motion.control)),
            ("a joint torque", rows(&motion.joint_torque)),
            ("the cost J", self.objective.is_finite()),
            ("the largest error", self.max_error.is_finite()),
            (
                "the base displacement",
                all(&[found.max_base_displacement, found.final_base_displacement]),
            ),
            (
                "the distance from a goal",
                goals.flatten().all(f64::is_finite),
            ),
        ]
        .into_iter()
        .find_map(|(what, finite)| (!finite).then_some(what))
    }

    /// Re-integrates the plan by equations that planning has no part in, and judges it by that.
    ///
    /// A solved plan for `problem` counts as not converged where the re-integration fails, or where
    /// it drifts too far from the plan: joints by more than a hundredth of the largest travel of a
    /// joint; the base by more than that angle, or than a tenth of the tightest limit on its
    /// attitude, but not below a milliradian. A warning then says so. Infeasible and interrupted
    /// plans are left as they are: there is no plan to check, or no time for it.
    pub fn verify(&mut self, problem: &Problem) {
        if matches!(self.status, Status::Infeasible | Status::Interrupted) {
            return;
        }
        let doubt = match verify(problem, &self.discretization) {
            Ok(found) => {
                self.verification = Some(found);
                self.drifted(problem, &found)
            }
            Err(error) => Some(format!("the plan could not be checked: {error}")),
        };
        if self.status == Status::Solved
            && let Some(doubt) = doubt
        {
            self.status = Status::NotConverged;
            self.warnings.push(doubt);
        }
    }

    /// A word where the re-integrated motion is too far from the plan.
    fn drifted(&self, problem: &Problem, found: &Verification) -> Option<String> {
        let joints = problem.robot.joints();
        let turns = joints.iter().all(|joint| joint.kind == JointKind::Revolute);
        let travel = self.travel();
        let (joint_room, base_room) = (DRIFT * travel, base_room(problem, DRIFT * travel));
        let shown = |value: f64| match turns {
            true => format!("{:.2}°", value.to_degrees()),
            false => format!("{value:.2e} rad or m"),
        };
        let (joint, base) = (found.max_joint_drift, found.max_base_attitude_drift);
        let helps = "a smaller mesh.tolerance brings it down; a joint that hardly any mass resists \
                     magnifies every error";
        let too_far = |drift: f64, room: f64| drift.is_nan() || drift > room;
        if too_far(joint, joint_room) {
            return Some(format!(
                "re-integrated under its control, the motion leaves the plan: joints drift by {}, \
                 more than the {} (a hundredth of their travel) that a solved plan may; {helps}",
                shown(joint),
                shown(joint_room)
            ));
        }
        too_far(base, base_room).then(|| {
            format!(
                "re-integrated under its control, the motion leaves the plan: the base drifts by \
                 {:.3}°, more than the {:.3}° that a solved plan may; {helps}",
                base.to_degrees(),
                base_room.to_degrees()
            )
        })
    }

    /// The largest way of a joint from where it was, rad or m.
    fn travel(&self) -> f64 {
        let rows = &self.trajectory.joint_position;
        let first = rows.first().map_or(&[][..], |row| row);
        let ways = rows.iter().flat_map(|row| row.iter().zip(first));
        largest(ways.map(|(q, start)| (q - start).abs()))
    }
}

/// How far the base may drift, rad.
fn base_room(problem: &Problem, travel: f64) -> f64 {
    let limits = &problem.limits;
    let bounds = limits
        .base_attitude
        .iter()
        .chain(&limits.final_base_attitude);
    let sizes = bounds.flat_map(|bound| [bound.lower.abs(), bound.upper.abs()]);
    let tightest = sizes.fold(f64::INFINITY, f64::min);
    travel.min(OF_LIMIT * tightest).max(NEGLIGIBLE)
}
