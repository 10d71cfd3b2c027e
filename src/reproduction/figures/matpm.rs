//! The minimum acceleration method the paper compares with, MATPM.

use super::Case;
use crate::collocation::Mesh;
use crate::dynamics::Data;
use crate::dynamics::space::Planar;
use crate::planner::{FreeFloating, Problem};
use crate::transcription::Discretization;

/// Steps of the base's turn along the path.
const STEPS: usize = 1000;
/// Points in each half of the motion.
const POINTS: usize = 12;

/// The motion of least largest acceleration from rest to rest, joints in step: half the time
/// speeding up, half slowing down, with 4Δθ/t_f². `None` where the motion is not planar.
///
/// Limits are not looked at: on the two-link task the rates stay below a fifth of theirs.
pub fn matpm(problem: &Problem) -> Option<Case> {
    let system = FreeFloating::planar(problem)?;
    let tree = system.tree();
    let task = &problem.task;
    let n = system.joint_count();
    let ends = task.initial_joints.iter().zip(&task.final_joints);
    let span: Vec<f64> = ends.map(|(from, to)| to - from).collect();
    let at = |part: f64, j: usize| task.initial_joints[j] + part * span[j];
    // The turn of the base depends on the part of the path alone, not on the speed along it.
    let mut data = Data::<Planar, f64>::new(tree);
    let mut turn = vec![0.0];
    for k in 0..STEPS {
        let part = (k as f64 + 0.5) / STEPS as f64;
        let q: Vec<f64> = (0..n).map(|j| at(part, j)).collect();
        tree.kinematics(&q, &mut data);
        tree.momentum(&mut data);
        tree.base_rate(&span, &mut data);
        turn.push(turn[turn.len() - 1] + data.base_rate.x / STEPS as f64);
    }
    let turned = |part: f64| {
        let place = part * STEPS as f64;
        let k = (place as usize).min(STEPS - 1);
        turn[k] + (place - k as f64) * (turn[k + 1] - turn[k])
    };
    let duration = task.duration.center();
    let mesh = Mesh::uniform(2, POINTS).ok()?;
    let trajectory = Discretization::sample(mesh, duration, 1 + 2 * n, n, |fraction, x, u| {
        let left = 1.0 - fraction;
        let (part, speed, push) = if fraction < 0.5 {
            (2.0 * fraction * fraction, 4.0 * fraction, 4.0)
        } else {
            (1.0 - 2.0 * left * left, 4.0 * left, -4.0)
        };
        x[0] = turned(part);
        for (j, span) in span.iter().enumerate() {
            x[1 + j] = at(part, j);
            x[1 + n + j] = span * speed / duration;
            u[j] = span * push / (duration * duration);
        }
    });
    Some(Case {
        name: "matpm",
        problem: problem.clone(),
        trajectory,
        iterations: Vec::new(),
    })
}
