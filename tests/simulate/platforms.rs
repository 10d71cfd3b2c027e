//! Platforms at rest, and what is compared.

use crate::problems::two_link;
use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::simulate::{Platform, Player, Run};
use ffsm_ipopt::transcription::Discretization;

/// A bandwidth at which joints hardly give, rad/s.
pub const STIFF: f64 = 400.0;

/// A plan of the two-link arm that holds its joints for `duration` seconds.
pub fn held(duration: f64) -> Player {
    let problem = Problem::builder("held", two_link(), duration, &[0.0; 2], &[0.0; 2])
        .build()
        .unwrap();
    let mesh = Mesh::uniform(1, 2).unwrap();
    let plan = Discretization::sample(mesh, duration, 5, 2, |_, _, _| {});
    Player::new(&problem, &plan, Platform::default()).unwrap()
}

/// Mass centre of the held arm in the base frame, m, its mass, kg, and inertia about it, kg m².
pub fn whole() -> (f64, f64, f64) {
    let bodies = [
        (15.20, 0.0, 0.1454),
        (1.70, 0.520, 0.0590),
        (1.20, 1.012, 0.0486),
    ];
    let mass: f64 = bodies.iter().map(|(m, ..)| m).sum();
    let center = bodies.iter().map(|(m, x, _)| m * x).sum::<f64>() / mass;
    let inertia = bodies
        .iter()
        .map(|(m, x, i)| i + m * (x - center).powi(2))
        .sum();
    (center, mass, inertia)
}

pub fn run(player: &Player, change: impl FnOnce(&mut Platform)) -> Run {
    let mut platform = player.platform().clone();
    change(&mut platform);
    player.on(platform).run(0).unwrap()
}

/// Displacement x and turn at every frame.
pub fn moved(run: &Run) -> impl Iterator<Item = (f64, f64, f64)> {
    let start = run.actual[0];
    run.t
        .iter()
        .zip(&run.actual)
        .map(move |(t, now)| (*t, now[0] - start[0], now[2] - start[2]))
}

pub fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!(
        (found - expected).abs() < tolerance,
        "{what}: {found}, expected {expected}"
    );
}
