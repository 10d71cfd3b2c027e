//! The minimum acceleration trajectory planning method: the largest acceleration of every joint is
//! the smallest that takes it from rest to rest in t_f.
//!
//! Without a bound on the rate that is full acceleration for half the time and full deceleration
//! for the other, at 4Δθ/t_f². Where the rate reached, 2Δθ/t_f, is above its bound v, the joint
//! cruises at v in between and accelerates at v²/(v t_f − Δθ), which is again the least. All
//! joints take the same time.
//!
//! Derived in docs/algorithms.md#matpm.

use super::joint_motion::{self, JointMotion, assemble, duration, rest_to_rest};
use crate::ocp::Interval;
use crate::planner::{Diagnosis, Method, Plan, PlanError};
use crate::problem::{LimitId, Problem};
use crate::system::{Component, System, Trajectory, by_quaternion, describe, with_system};
use crate::text::digits::digits;
use std::time::Instant;

/// Plans `problem`'s task with the least largest acceleration of every joint.
///
/// Where a joint cannot be there in time at its largest rate, the plan is infeasible and its
/// motion the profile without that bound.
///
/// # Errors
/// [`PlanError`] for a task that is not from rest to rest in joint space.
pub(in crate::planner) fn plan(problem: &Problem) -> Result<Plan, PlanError> {
    let began = Instant::now();
    let method = Method::Matpm;
    rest_to_rest(method, problem)?;
    let motion = BangCruiseBang::new(problem);
    let mut plan = with_system!(&System::new(problem), system => assemble(problem, system, method, &motion, began))?;
    if let Some(diagnosis) = &mut plan.diagnosis {
        too_fast(problem, &motion, diagnosis);
    }
    Ok(plan)
}

/// Times, joint positions and poses of the base along that motion; `None` where the task is not from rest to rest in
/// joint space, or a joint cannot be there in time.
pub fn poses(problem: &Problem) -> Option<Trajectory> {
    if let Some(other) = by_quaternion(problem) {
        let mut motion = poses(&other)?;
        describe(problem.attitude, &mut motion);
        return Some(motion);
    }
    rest_to_rest(Method::Matpm, problem).ok()?;
    let motion = BangCruiseBang::new(problem);
    let late = motion.joints.iter().any(|joint| joint.late);
    let found =
        || with_system!(&System::new(problem), system => joint_motion::poses(system, &motion));
    (!late).then(found)
}

/// Names the least rates with which the joints that are too slow would be there in time; what the
/// profile without a bound reaches is twice as much.
fn too_fast(problem: &Problem, motion: &BangCruiseBang, diagnosis: &mut Diagnosis) {
    let joints = problem.robot.joints();
    let mut sentences = Vec::new();
    for (j, joint) in motion.joints.iter().enumerate().filter(|(_, j)| j.late) {
        let needed = joint.way.abs() / motion.duration();
        let found = diagnosis.limits.iter_mut();
        for limit in found.filter(|limit| {
            limit.limit == LimitId::JointVelocity && limit.component == Component::JointRate(j)
        }) {
            limit.excess = needed - joint.rate;
            limit.smallest_bound = if limit.bound.lower == -limit.bound.upper {
                Interval::symmetric(needed)
            } else {
                let signed = needed * joint.way.signum();
                Interval::new(limit.bound.lower.min(signed), limit.bound.upper.max(signed))
            };
        }
        sentences.push(format!(
            "joint '{}' cannot be there in {} s: that takes a rate above {}, and {} is allowed",
            joints[j].name,
            motion.duration(),
            digits(needed, 4, 3),
            digits(joint.rate, 4, 3)
        ));
    }
    if !sentences.is_empty() {
        diagnosis.summary = format!("{}; {}", sentences.join("; "), diagnosis.summary);
    }
}

/// One joint's profile: accelerate, cruise (or not), decelerate.
#[derive(Debug, Clone, Copy)]
struct Profile {
    start: f64,
    way: f64,
    /// Acceleration with its sign, rad/s² or m/s².
    acceleration: f64,
    /// Time until it ends, s.
    until: f64,
    /// Largest rate allowed towards the goal.
    rate: f64,
    /// Whether even that rate is too slow; the profile then knows no bound.
    late: bool,
}

impl Profile {
    fn new(start: f64, way: f64, bound: &Interval, duration: f64) -> Self {
        let rate = if way < 0.0 { -bound.lower } else { bound.upper };
        let late = way != 0.0 && way.abs() >= rate * duration;
        let (acceleration, until) = if late || 2.0 * way.abs() <= rate * duration {
            (4.0 * way / (duration * duration), 0.5 * duration)
        } else {
            let room = rate * duration - way.abs();
            (rate * rate / room * way.signum(), room / rate)
        };
        Self {
            start,
            way,
            acceleration,
            until,
            rate,
            late,
        }
    }
}

struct BangCruiseBang {
    joints: Vec<Profile>,
    breakpoints: Vec<f64>,
}

impl BangCruiseBang {
    fn new(problem: &Problem) -> Self {
        let duration = duration(problem);
        let task = &problem.task;
        let ends = task.initial_joints.iter().zip(&task.final_joints);
        let joints: Vec<Profile> = ends
            .zip(&problem.limits.joint_velocity)
            .map(|((from, to), bound)| Profile::new(*from, to - from, bound, duration))
            .collect();
        let mut breakpoints = vec![0.0, duration];
        for joint in joints.iter().filter(|joint| joint.way != 0.0) {
            breakpoints.extend([joint.until, duration - joint.until]);
        }
        breakpoints.sort_by(f64::total_cmp);
        // Two times that rounding alone keeps apart are one.
        breakpoints.dedup_by(|b, a| *b - *a <= 1e-12 * duration);
        if let Some(last) = breakpoints.last_mut() {
            *last = duration;
        }
        Self {
            joints,
            breakpoints,
        }
    }

    fn duration(&self) -> f64 {
        self.breakpoints[self.breakpoints.len() - 1]
    }
}

impl JointMotion for BangCruiseBang {
    fn breakpoints(&self) -> &[f64] {
        &self.breakpoints
    }

    fn at(&self, piece: usize, t: f64, q: &mut [f64], dq: &mut [f64], ddq: &mut [f64]) {
        let duration = self.duration();
        let middle = 0.5 * (self.breakpoints[piece] + self.breakpoints[piece + 1]);
        for (j, joint) in self.joints.iter().enumerate() {
            let (a, until) = (joint.acceleration, joint.until);
            (q[j], dq[j], ddq[j]) = if middle < until {
                (joint.start + 0.5 * a * t * t, a * t, a)
            } else if middle < duration - until {
                let cruise = a * until;
                (joint.start + cruise * (t - 0.5 * until), cruise, 0.0)
            } else {
                let left = duration - t;
                let end = joint.start + joint.way;
                (end - 0.5 * a * left * left, a * left, -a)
            };
        }
    }
}
