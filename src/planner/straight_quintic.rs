//! The straight joint path with quintic timing: rates and accelerations vanish at both ends.

use super::joint_motion::{JointMotion, assemble, duration, rest_to_rest};
use super::{FreeFloating, Method, Plan, PlanError, Problem};
use std::time::Instant;

/// Plans `problem`'s task along the straight joint path.
///
/// # Errors
/// [`PlanError`] for a task that is not from rest to rest in joint space.
pub(super) fn plan(problem: &Problem) -> Result<Plan, PlanError> {
    let began = Instant::now();
    let method = Method::StraightLine;
    rest_to_rest(method, problem)?;
    let motion = Quintic {
        from: problem.task.initial_joints.clone(),
        to: problem.task.final_joints.clone(),
        ends: [0.0, duration(problem)],
    };
    match FreeFloating::planar(problem) {
        Some(planar) => assemble(problem, &planar, method, &motion, began),
        None => {
            let spatial = FreeFloating::spatial(problem);
            assemble(problem, &spatial, method, &motion, began)
        }
    }
}

struct Quintic {
    from: Vec<f64>,
    to: Vec<f64>,
    ends: [f64; 2],
}

impl JointMotion for Quintic {
    fn breakpoints(&self) -> &[f64] {
        &self.ends
    }

    fn at(&self, _piece: usize, t: f64, q: &mut [f64], dq: &mut [f64], ddq: &mut [f64]) {
        let [share, rate, acceleration] = quintic(t, self.ends[1]);
        for (j, (from, to)) in self.from.iter().zip(&self.to).enumerate() {
            q[j] = from + share * (to - from);
            dq[j] = rate * (to - from);
            ddq[j] = acceleration * (to - from);
        }
    }
}

/// The share of the way at `t` of `duration` seconds, 10p³ − 15p⁴ + 6p⁵ with p = t/duration, and
/// its first two derivatives by time.
pub(super) fn quintic(t: f64, duration: f64) -> [f64; 3] {
    let p = t / duration;
    [
        p * p * p * (10.0 + p * (6.0 * p - 15.0)),
        30.0 * p * p * (1.0 - p) * (1.0 - p) / duration,
        60.0 * p * (1.0 - p) * (1.0 - 2.0 * p) / (duration * duration),
    ]
}
