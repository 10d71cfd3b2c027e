//! Optimal control problems with closed-form answers, through the generic interface.

mod as_stated;
mod brachistochrone;
mod hypersensitive;
mod integrals;
mod integrators;
mod parameters;
mod structure;
mod times;
mod way_points;

use ffsm_ipopt::nlp::{self, Control};
use ffsm_ipopt::ocp::{Interval, Ocp, Quantity};
use ffsm_ipopt::refine::{Outcome, Refinement, Settings};
use ffsm_ipopt::transcription::Patterns;

/// Solves from the straight line and refines to the tolerance.
fn solve<O: Ocp>(ocp: &O, settings: &Settings) -> Outcome {
    settings.validate().unwrap();
    let mut solver = nlp::Settings::default();
    solver.max_iterations = 2000;
    let patterns = Patterns::detect(ocp);
    let refinement = Refinement {
        ocp,
        patterns: &patterns,
        settings,
        solver: &solver,
    };
    let start = refinement.straight_start().unwrap();
    let outcome = refinement.run(&start, &mut |_| Control::Continue).unwrap();
    assert!(outcome.status.is_solved(), "{:?}", outcome.status);
    outcome
}

fn refined(segments: usize, points: usize, tolerance: f64, max_iterations: usize) -> Settings {
    Settings {
        segments,
        points,
        tolerance,
        max_iterations: Some(max_iterations),
        ..Settings::default()
    }
}

fn states(bounds: &[(&str, Interval)]) -> Vec<Quantity> {
    bounds
        .iter()
        .map(|(name, b)| Quantity::new(*name, *b))
        .collect()
}

fn fixed(values: &[f64]) -> Vec<Interval> {
    values.iter().copied().map(Interval::fixed).collect()
}
