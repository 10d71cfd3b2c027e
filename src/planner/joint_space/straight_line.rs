//! The straight joint path with quintic timing: rates and accelerations vanish at both ends.

use super::joint_motion::{JointMotion, assemble, duration, rest_to_rest};
use crate::planner::{Method, Plan, PlanError};
use crate::problem::Problem;
use crate::system::{System, quintic, with_system};
use std::time::Instant;

/// Plans `problem`'s task along the straight joint path.
///
/// # Errors
/// [`PlanError`] for a task that is not from rest to rest in joint space.
pub(in crate::planner) fn plan(problem: &Problem) -> Result<Plan, PlanError> {
    let began = Instant::now();
    let method = Method::StraightLine;
    rest_to_rest(method, problem)?;
    let motion = Quintic {
        from: problem.task.initial_joints.clone(),
        to: problem.task.final_joints.clone(),
        ends: [0.0, duration(problem)],
    };
    with_system!(&System::new(problem), system => assemble(problem, system, method, &motion, began))
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
