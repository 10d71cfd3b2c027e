//! Runs as a whole.

use crate::platforms::*;
use crate::problems::two_link;
use crate::trees;
use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::simulate::{Figures, Platform, Player, Run, SimulateError};
use ffsm_ipopt::transcription::Discretization;

#[test]
fn the_same_seed_gives_the_same_bits() {
    let player = held(2.0);
    let noisy = |seed: u64, index: usize| {
        let mut platform = player.platform().clone();
        platform.seed = seed;
        platform.actuator.torque_noise = 0.01;
        platform.encoder.position_noise = 1e-4;
        platform.encoder.rate_noise = 1e-3;
        platform.release.velocity_noise = 1e-3;
        platform.release.rate_noise = 1e-3;
        platform.capture.position_noise = 1e-4;
        platform.capture.attitude_noise = 1e-4;
        player.on(platform).run(index).unwrap()
    };
    let bits = |run: &Run| -> Vec<u64> {
        let poses = run.measured.iter().chain(&run.actual).flatten();
        let torques = run.joint_torque.iter().flatten();
        poses.chain(torques).map(|value| value.to_bits()).collect()
    };
    let one = noisy(7, 0);
    assert_eq!(bits(&one), bits(&noisy(7, 0)));
    for other in [noisy(8, 0), noisy(7, 1)] {
        let [a, b] = [&one, &other].map(Figures::measured);
        assert!((a.final_attitude - b.final_attitude).abs() > 1e-6);
        assert!((a.final_displacement[0] - b.final_displacement[0]).abs() > 1e-6);
    }
    // What is switched off takes nothing from the rest.
    let mut platform = player.platform().clone();
    platform.seed = 7;
    platform.release.velocity_noise = 1e-3;
    platform.release.rate_noise = 1e-3;
    let released = player.on(platform).run(0).unwrap();
    let [a, b] = [&one, &released].map(|run| run.actual[1][0] - run.actual[0][0]);
    assert!((a - b).abs() < 0.02 * b.abs(), "{a} {b}");
}

#[test]
fn robots_in_space_are_refused() {
    let model = trees::chain(3, 4);
    let problem = Problem::builder("space", model, 5.0, &[0.0; 3], &[0.0; 3])
        .build()
        .unwrap();
    let mesh = Mesh::uniform(1, 2).unwrap();
    let plan = Discretization::sample(mesh, 5.0, 9, 3, |_, _, _| {});
    let error = Player::new(&problem, &plan, Platform::default()).unwrap_err();
    assert!(matches!(error, SimulateError::NotPlanar { .. }), "{error}");
    assert_eq!(error.to_string().lines().count(), 1);

    let other = Problem::builder("other", two_link(), 5.0, &[0.0; 2], &[0.0; 2])
        .build()
        .unwrap();
    let error = Player::new(&other, &plan, Platform::default()).unwrap_err();
    assert!(matches!(error, SimulateError::Plan(_)), "{error}");
}
