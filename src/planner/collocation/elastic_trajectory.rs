//! Trajectories with and without the amounts of an elastic problem.

use crate::ocp::{Elastic, InteriorPoint, Ocp};
use crate::transcription::Discretization;

/// Part by which the first amounts are more than the trajectory needs: room for the solver.
const ROOM: f64 = 0.01;

/// The trajectory with the first amounts of `elastic`, within which it is.
pub(super) fn extend<O: Ocp>(
    trajectory: Discretization,
    elastic: &Elastic<'_, O>,
) -> Discretization {
    let formulation = elastic.formulation();
    let (mesh, times) = (&trajectory.mesh, trajectory.times());
    let points = (0..mesh.points())
        .map(|k| trajectory.point(trajectory.state(k), trajectory.control(k), times[k]));
    let way_points = formulation.way_points.iter().enumerate();
    let way_points = way_points.filter_map(|(way_point, at)| {
        let k = mesh.node_at(at.fraction)?;
        Some(InteriorPoint {
            way_point,
            x: trajectory.state(k),
            parameters: &trajectory.parameters,
            t: times[k],
        })
    });
    let needed = elastic.needed(points, way_points, trajectory.ends());
    let guess = &formulation.parameter_guess[elastic.amounts()];
    let first = guess.iter().zip(needed);
    let mut parameters = trajectory.parameters.clone();
    parameters.extend(first.map(|(guess, needed)| guess.max(needed * (1.0 + ROOM))));
    let from = trajectory.initial_time;
    trajectory.with(from, parameters)
}

/// The trajectory without the amounts of `elastic`.
pub(super) fn strip<O: Ocp>(
    trajectory: &Discretization,
    elastic: &Elastic<'_, O>,
) -> Discretization {
    let mut parameters = trajectory.parameters.clone();
    parameters.truncate(elastic.amounts().start);
    trajectory.clone().with(trajectory.initial_time, parameters)
}
