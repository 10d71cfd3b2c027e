//! Verification as a step of planning: a plan that does not hold what it says is not solved.

use super::collocation::diagnosis::findings;
use super::conditioning::most_extreme;
use super::{Doubt, Instability, Plan, Status};
use crate::dynamics::space::Space;
use crate::numeric::largest_or_nan;
use crate::ocp::{Limited, Ocp};
use crate::problem::{Problem, Unit};
use crate::system::{FreeFloating, System, with_system};
use crate::transcription::Discretization;
use crate::verify::{Verification, verify};

/// Part of the largest joint travel by which a re-integrated motion may drift from the plan.
const DRIFT: f64 = 1e-2;
/// Part of the tightest limit on the base attitude by which the base may drift.
const OF_LIMIT: f64 = 0.1;
/// Drift of the base that counts for nothing, rad.
const NEGLIGIBLE: f64 = 1e-3;
/// Drift of a joint that counts for nothing, rad or m: far above rounding, far below any use.
const ROUNDING: f64 = 1e-9;
/// How far a state of a solved plan may be from where its task has it, in SI units.
const THERE: f64 = 1e-4;
/// The same of the duration, relative.
const IN_TIME: f64 = 1e-6;

/// What came of checking a plan.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Judgement {
    /// What re-integration found; `None` where it failed.
    pub verification: Option<Verification>,
    /// Why the plan is not what it says; `None` where nothing speaks against it.
    pub doubt: Option<Doubt>,
    /// What makes small errors grow where the plan holds and its control alone does not keep to it.
    pub instability: Option<Instability>,
}

/// Re-integrates `plan` by equations that planning has no part in, and judges it by that.
///
/// It is doubted where the re-integration fails, or where it drifts too far from the plan: joints by
/// more than a hundredth of the largest travel of a joint; the base by more than that angle, or than
/// a tenth of the tightest limit on its attitude, but not below a milliradian. It is not doubted where
/// what each segment drifts by itself comes to less than a tenth of that: then the motion is unstable,
/// and the plan is right.
pub fn judge(problem: &Problem, plan: &Discretization) -> Judgement {
    let (found, doubt) = match verify(problem, plan) {
        Ok(found) => (Some(found), drifted(problem, plan, &found)),
        Err(error) => (None, Some(Doubt::Unchecked(error))),
    };
    let instability = doubt
        .as_ref()
        .and_then(|doubt| Instability::behind(doubt, problem, plan));
    Judgement {
        verification: found,
        doubt: doubt.filter(|_| instability.is_none()),
        instability,
    }
}

/// [`judge`] of a plan that is said to be solved: it is also to take the time of its task, to begin
/// and end where that says, and to keep to all limits at its nodes.
pub fn judge_solved(problem: &Problem, plan: &Discretization) -> Judgement {
    let mut found = judge(problem, plan);
    if found.doubt.is_none() {
        found.doubt = late(problem, plan).or_else(
            || with_system!(&System::new(problem), system => misplaced(problem, system, plan)),
        );
    }
    found
}

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

    /// [`judge`]s the plan, by which it counts as not converged where there is a doubt.
    ///
    /// A warning then says so. Infeasible and interrupted plans are left as they are: there is no
    /// plan to check, or no time for it.
    pub fn verify(&mut self, problem: &Problem) {
        if let Some(judgement) = self.judgement(problem) {
            self.accept(judgement);
        }
    }

    /// What [`verify`](Self::verify) finds, for [`accept`](Self::accept); nothing for plans that it leaves
    /// as they are.
    pub(crate) fn judgement(&self, problem: &Problem) -> Option<Judgement> {
        let left = matches!(self.status, Status::Infeasible | Status::Interrupted);
        (!left).then(|| judge(problem, &self.discretization))
    }

    /// Takes over what was found.
    pub(crate) fn accept(&mut self, judgement: Judgement) {
        let Judgement {
            verification,
            doubt,
            instability,
        } = judgement;
        self.verification = verification;
        self.warnings.extend(instability.map(|it| it.to_string()));
        if self.status == Status::Solved
            && let Some(doubt) = doubt
        {
            self.status = Status::NotConverged;
            self.warnings.push(doubt.to_string());
        }
    }
}

/// Whether the re-integrated motion is too far from the plan.
fn drifted(problem: &Problem, plan: &Discretization, found: &Verification) -> Option<Doubt> {
    let travel = travel(problem, plan);
    let joint_room = (DRIFT * travel).max(ROUNDING);
    let base_room = base_room(problem, DRIFT * travel);
    let too_far = |drift: f64, room: f64| drift.is_nan() || drift > room;
    if too_far(found.max_joint_drift, joint_room) {
        let joint = &problem.robot.joints()[found.worst_joint];
        return Some(Doubt::JointDrift {
            joint: joint.name.clone(),
            unit: Unit::position(joint.kind),
            drift: found.max_joint_drift,
            room: joint_room,
            conditioning: most_extreme(problem, plan),
        });
    }
    too_far(found.max_base_attitude_drift, base_room).then(|| Doubt::BaseDrift {
        drift: found.max_base_attitude_drift,
        room: base_room,
        led: found.replay_base_attitude_drift,
        conditioning: most_extreme(problem, plan),
    })
}

/// The largest way of a joint from where it was, rad or m.
fn travel(problem: &Problem, plan: &Discretization) -> f64 {
    let (parameters, _) = problem.attitude_sizes();
    let n = problem.robot.joint_count();
    let joints = |k: usize| &plan.state(k)[parameters..parameters + n];
    let ways = (0..=plan.mesh.points()).flat_map(|k| joints(k).iter().zip(joints(0)));
    largest_or_nan(ways.map(|(q, start)| (q - start).abs()))
}

/// Whether the plan takes another time than its task gives.
fn late(problem: &Problem, plan: &Discretization) -> Option<Doubt> {
    let allowed = problem.task.duration;
    (allowed.violation(plan.duration) > IN_TIME * plan.duration).then_some(Doubt::Duration {
        found: plan.duration,
        expected: [allowed.lower, allowed.upper],
    })
}

/// The first state that is not where the task begins or ends, else the limits that do not hold.
fn misplaced<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    plan: &Discretization,
) -> Option<Doubt> {
    let formulation = system.formulation();
    let last = plan.mesh.points();
    for i in 0..plan.states {
        for (k, bounds, row) in [
            (0, formulation.initial[i], Limited::State(i)),
            (last, formulation.terminal[i], Limited::Terminal(i)),
        ] {
            let found = plan.state(k)[i];
            // Limits on the base at the end are limits, and said below.
            if bounds.is_fixed() && bounds.violation(found) > THERE {
                let row = system.bound(row);
                return Some(Doubt::Ends {
                    name: row.quantity.name.clone(),
                    unit: row.unit,
                    time: plan.mesh.node_fractions()[k] * plan.duration,
                    found,
                    expected: bounds.lower,
                });
            }
        }
    }
    let limits = findings(problem, system, &system.elastic_limits(), plan);
    (!limits.is_empty()).then_some(Doubt::Limits(limits))
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
