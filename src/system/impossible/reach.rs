//! Goals of the end effector that lie beyond its reach.

use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::ocp::Interval;
use crate::problem::{EndEffectorGoal, GoalFrame, Impossible, LimitId, Problem};
use crate::system::plant::Plant;

/// Part of the reach by which a goal may lie beyond it: rounding, of the file as well.
const ROOM: f64 = 1e-6;

pub(super) fn reasons<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> Vec<Impossible> {
    let task = &problem.task;
    let at_end = task.end_effector.iter();
    let at_end = at_end.map(|goal| (LimitId::EndEffector, goal, 1.0));
    let points = task.way_points.iter().enumerate();
    let on_the_way = points.filter_map(|(i, point)| {
        let fraction = point.fraction(&task.duration);
        Some((LimitId::WayPoint(i), point.end_effector.as_ref()?, fraction))
    });
    at_end
        .chain(on_the_way)
        .filter_map(|(id, goal, fraction)| out_of_reach(problem, plant, id, goal, fraction))
        .collect()
}

/// Whether `goal`, met at that fraction of the duration, lies beyond reach.
fn out_of_reach<Sp: Space>(
    problem: &Problem,
    plant: &Plant<Sp>,
    id: LimitId,
    goal: &EndEffectorGoal,
    fraction: f64,
) -> Option<Impossible> {
    let point = Sp::Linear::<f64>::from_components(goal.position.as_deref()?);
    let end_effector = problem.robot.end_effector()?;
    let mount = plant
        .tree
        .mount(end_effector.joint, &end_effector.placement);
    let travel: Vec<f64> = (problem.limits.joint_position.iter())
        .map(|bound| bound.lower.abs().max(bound.upper.abs()))
        .collect();
    let (from_base, offset, reach) = match goal.frame {
        GoalFrame::Base => {
            let ball = plant.tree.reach_from_base(&mount, &travel);
            (true, point - ball.center, ball.radius)
        }
        GoalFrame::Inertial => (false, point, plant.tree.reach_from_center(&mount, &travel)),
        GoalFrame::Start => {
            let along = plant.attitude.to_inertial(&plant.start_attitude, &point);
            let reach = plant.tree.reach_from_center(&mount, &travel);
            (false, along + plant.start_position, reach)
        }
    };
    let distance = match from_base {
        true => norm(offset.components()),
        false => {
            let Interval { lower, upper } = problem.task.duration;
            nearest(plant, &offset, [lower, upper].map(|t| fraction * t))
        }
    };
    // Of the box around the goal no corner is farther from its middle.
    let tolerance = goal.position_tolerance * (Sp::LENGTHS as f64).sqrt();
    let distance = distance - tolerance;
    let size = reach + tolerance + norm(point.components());
    (distance > reach + ROOM * size).then_some(Impossible::OutOfReach {
        goal: id,
        from_base,
        distance,
        reach,
    })
}

/// The least distance of `point` from the system's mass centre, which drifts with the momentum,
/// between two times.
fn nearest<Sp: Space>(plant: &Plant<Sp>, point: &Sp::Linear<f64>, times: [f64; 2]) -> f64 {
    let from = |t: f64| {
        let mut center = Sp::Linear::<f64>::zero();
        plant.drift.carry(t, center.components_mut());
        *point - center
    };
    let [a, b] = times.map(from);
    let way = b - a;
    let square = way.dot(&way);
    let share = match square > 0.0 {
        true => (-a.dot(&way) / square).clamp(0.0, 1.0),
        false => 0.0,
    };
    norm((a + way.times(share)).components())
}

fn norm(components: &[f64]) -> f64 {
    components.iter().map(|c| c * c).sum::<f64>().sqrt()
}
