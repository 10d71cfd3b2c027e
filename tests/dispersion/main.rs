//! A plan replayed under perturbations, against closed forms and a second algorithm.

mod brute_force;
mod closed_form;
mod command;
#[path = "../problems/mod.rs"]
mod problems;
#[path = "../program/mod.rs"]
mod program;
mod same_results;

use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::config::{Dispersion, Overrides, ProblemFile};
use ffsm_ipopt::nlp::Control;
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::study::dispersion::{Figures, Replays};
use ffsm_ipopt::transcription::Discretization;

/// What `--set` of these says, and nothing else.
pub fn only(problem: &Problem, sets: &[&str]) -> Dispersion {
    let mut dispersion = Dispersion::none(&problem.robot);
    for set in sets {
        dispersion.set(&problem.robot, set).unwrap();
    }
    dispersion
}

/// Figures of the first samples.
pub fn run(replays: &Replays<'_>, count: u64) -> Vec<Figures> {
    replays.run(count, &mut |_| Control::Continue).unwrap()
}

/// The seven-joint chaser with its base attitude described by three angles, or otherwise.
pub fn chaser(attitude: &str) -> Problem {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/chaser.toml");
    let overrides = Overrides::of(&[format!("base.attitude={attitude}")]).unwrap();
    ProblemFile::load(path.as_ref(), &overrides)
        .unwrap()
        .problem
}

/// A motion of given attitude and joint positions along the fraction of the duration, on an even mesh.
pub fn motion(
    problem: &Problem,
    duration: f64,
    at: impl Fn(f64) -> (Vec<f64>, Vec<f64>),
) -> Discretization {
    let n = problem.robot.joint_count();
    let angles = problem.attitude_sizes().0;
    let mesh = Mesh::uniform(4, 8).unwrap();
    Discretization::sample(mesh, duration, angles + 2 * n, n, |fraction, x, _| {
        let (eta, q) = at(fraction);
        x[..angles].copy_from_slice(&eta);
        x[angles..angles + n].copy_from_slice(&q);
    })
}
