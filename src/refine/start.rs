//! Where a refinement starts from.

use crate::collocation::Mesh;
use crate::nlp::Iterate;
use crate::ocp::{Formulation, Interval};
use crate::transcription::Discretization;

/// Where the loop starts from.
#[derive(Debug, Clone, PartialEq)]
pub struct Start {
    /// The first mesh and a trajectory on it.
    pub trajectory: Discretization,
    /// Multipliers that belong to the trajectory, for a warm start.
    pub iterate: Option<Iterate>,
}

/// A straight line between the ends of every state, with all controls zero or as near to it as their bounds allow.
pub(super) fn straight(formulation: &Formulation, mesh: Mesh) -> Discretization {
    let (states, controls) = formulation.widths();
    let duration = formulation.duration.typical();
    let straight = Discretization::sample(mesh, duration, states, controls, |part, x, u| {
        for (i, value) in x.iter_mut().enumerate() {
            let bounds = &formulation.states[i].bounds;
            let ends = [&formulation.initial[i], &formulation.terminal[i]];
            let [start, end] = line(ends.map(|end| end.intersect(bounds)), ends);
            *value = start + part * (end - start);
        }
        for (value, control) in u.iter_mut().zip(&formulation.controls) {
            *value = control.bounds.clamp(0.0);
        }
    });
    guessed(formulation, straight)
}

/// `trajectory` with t₀ and the static parameters as the formulation guesses them.
pub(super) fn guessed(formulation: &Formulation, trajectory: Discretization) -> Discretization {
    let guesses = formulation
        .parameters
        .iter()
        .zip(&formulation.parameter_guess);
    let parameters = guesses
        .map(|(parameter, &guess)| parameter.bounds.clamp(guess))
        .collect();
    trajectory.with(formulation.initial_time.center(), parameters)
}

/// Ends of a straight line within `ends`, the bounds along the path included; `instants` are those
/// of the ends alone. What is open at one end stays as it is at the other.
fn line(ends: [Interval; 2], instants: [&Interval; 2]) -> [f64; 2] {
    let meant = |k: usize| {
        let (end, instant) = (ends[k], instants[k]);
        let both = instant.lower.is_finite() && instant.upper.is_finite();
        (end.is_fixed() || both).then(|| end.center())
    };
    match [meant(0), meant(1)] {
        [Some(start), Some(end)] => [start, end],
        [Some(start), None] => [start, ends[1].clamp(start)],
        [None, Some(end)] => [ends[0].clamp(end), end],
        [None, None] => ends.map(|end| end.clamp(0.0)),
    }
}
