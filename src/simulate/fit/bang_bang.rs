//! The joint path of least largest acceleration (MATPM), for experiments that played it.

use crate::collocation::Mesh;
use crate::planner::Problem;
use crate::transcription::Discretization;

/// All joints from rest to rest in the whole duration, at full acceleration for the first half
/// and full deceleration for the second: 4Δθ/t_f², reached at a rate of 2Δθ/t_f.
///
/// The base is left where it starts, for what is played is the joint path. `None` where the
/// profile is another: a rate limit in its way, joints that do not start at rest, a duration or
/// goal for the planner to find.
pub fn bang_bang(problem: &Problem) -> Option<Discretization> {
    let task = &problem.task;
    let duration = task.duration.lower;
    let (from, to) = (&task.initial_joints, &task.final_joints);
    let n = from.len();
    let within = (0..n).all(|j| {
        let limit = &problem.limits.joint_velocity[j];
        let peak = 2.0 * (to[j] - from[j]) / duration;
        limit.lower <= peak && peak <= limit.upper
    });
    let rest = task.initial_rates.iter().all(|rate| *rate == 0.0);
    if !(within && rest && task.duration.is_fixed() && task.end_effector.is_none()) {
        return None;
    }
    let (angles, _) = Problem::base_sizes(&problem.robot);
    let mesh = Mesh::uniform(2, 3).ok()?;
    Some(Discretization::sample(
        mesh,
        duration,
        angles + 2 * n,
        n,
        |fraction, x, _| {
            let left = 1.0 - fraction;
            // Share of the way, and its rate.
            let (way, rate) = if fraction < 0.5 {
                (2.0 * fraction * fraction, 4.0 * fraction)
            } else {
                (1.0 - 2.0 * left * left, 4.0 * left)
            };
            for j in 0..n {
                let span = to[j] - from[j];
                x[angles + j] = from[j] + way * span;
                x[angles + n + j] = rate * span / duration;
            }
        },
    ))
}
