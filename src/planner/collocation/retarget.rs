//! A saved trajectory bent towards a changed task.

use crate::problem::Problem;
use crate::system::quintic;
use crate::transcription::Discretization;

/// `saved` with its joints led from the start to the goal of `problem`, and in its time.
///
/// A joint's motion is scaled about its start, which keeps the shape it has: where its limits
/// begin and cease to be active. A joint that hardly moved, or is to turn back, takes the
/// difference along a quintic instead. The base stays as it was; the solver moves it in one step.
///
/// Goals for the end effector name no joints, and the trajectory is left as it is.
pub(super) fn retarget(saved: &Discretization, problem: &Problem) -> Discretization {
    let mut bent = saved.clone();
    let task = &problem.task;
    bent.duration = task.duration.clamp(saved.duration);
    if task.end_effector.is_some() {
        return bent;
    }
    let n = saved.controls;
    let angles = saved.states - 2 * n;
    let stretch = saved.duration / bent.duration;
    let last = saved.mesh.points();
    let fractions = saved.mesh.node_fractions();
    for j in 0..n {
        let (q, dq) = (angles + j, angles + n + j);
        let (from, to) = (saved.state(0)[q], saved.state(last)[q]);
        let (start, goal) = (task.initial_joints[j], task.final_joints[j]);
        let (old, new) = (to - from, goal - start);
        let (ratio, rest) = if (new - old).abs() <= old.abs() && old != 0.0 {
            (new / old, 0.0)
        } else {
            (1.0, new - old)
        };
        for (k, &fraction) in fractions.iter().enumerate() {
            let [blend, slope, bend] = quintic(fraction, 1.0);
            let x = &mut bent.x[k * saved.states..(k + 1) * saved.states];
            x[q] = start + ratio * (x[q] - from) + rest * blend;
            x[dq] = ratio * stretch * x[dq] + rest * slope / bent.duration;
            if k < last {
                let u = &mut bent.u[k * n + j];
                *u = ratio * stretch.powi(2) * *u + rest * bend / bent.duration.powi(2);
            }
        }
    }
    bent
}
