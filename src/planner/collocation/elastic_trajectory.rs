//! Trajectories with and without the amounts of an elastic problem.

use crate::ocp::{Elastic, Ocp};
use crate::transcription::Discretization;

/// The trajectory with the first amounts of `elastic`.
pub(super) fn extend<O: Ocp>(
    trajectory: Discretization,
    elastic: &Elastic<'_, O>,
) -> Discretization {
    let guess = elastic.formulation().parameter_guess;
    let mut parameters = trajectory.parameters.clone();
    parameters.extend(&guess[elastic.amounts()]);
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
