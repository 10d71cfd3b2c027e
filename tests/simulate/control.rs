//! Controller, actuator, measurement.

use crate::platforms::*;
use crate::problems::{relaxed, smooth};
use ffsm_ipopt::planner::plan;
use ffsm_ipopt::simulate::{Law, Platform, Player, SimulateError};

#[test]
fn delay_shifts_the_torque_and_nothing_else() {
    let problem = smooth();
    let plan = plan(&problem).unwrap();
    let player = Player::new(&problem, &plan.discretization, Platform::default()).unwrap();
    let open_loop = |delay: f64| {
        run(&player, |platform| {
            platform.controller.law = Law::PdFeedForward;
            platform.controller.bandwidth = 0.0;
            platform.actuator.delay = delay;
            platform.capture.rate = 250.0;
        })
    };
    // 35.5 ms, half a sample more than a whole number of them: 9 frames cover it.
    let (prompt, late) = (open_loop(0.0), open_loop(0.0355));
    let frame = 0.004;
    for (k, torque) in late.joint_torque.iter().enumerate() {
        let t = k as f64 * frame - 0.0355;
        if t < 0.0 {
            assert_eq!(*torque, [0.0; 2]);
            continue;
        }
        // The sample that was held then.
        let sample = (t / 1e-3 + 1e-9).floor() * 1e-3;
        let whole = sample / frame;
        if (whole - whole.round()).abs() < 1e-6 {
            assert_eq!(torque, &prompt.joint_torque[whole.round() as usize], "{k}");
        }
    }
    assert!(late.max_joint_error > prompt.max_joint_error + 1e-5);
}

#[test]
fn a_torque_limit_holds() {
    let problem = relaxed();
    let plan = plan(&problem).unwrap();
    let player = Player::new(&problem, &plan.discretization, Platform::default()).unwrap();
    let run = run(&player, |platform| platform.actuator.torque_limit = 0.05);
    let peak = |j: usize| {
        run.joint_torque
            .iter()
            .fold(0f64, |m, row| m.max(row[j].abs()))
    };
    assert!(peak(0) <= 0.05 && peak(1) <= 0.05);
    assert!(run.max_joint_error > 1e-3, "{}", run.max_joint_error);
}

#[test]
fn the_measurement_scatters_about_the_tracked_point() {
    let noise = (2e-3, 5e-4);
    let point = [0.1, -0.2, 0.0];
    let run = run(&held(40.0), |platform| {
        platform.capture.position_noise = noise.0;
        platform.capture.attitude_noise = noise.1;
        platform.capture.point = point;
        platform.capture.rate = 50.0;
    });
    assert_eq!(run.t.len(), 2001);
    let spread = |k: usize, expected: f64, deviation: f64| {
        let count = run.t.len() as f64;
        let mean = run.measured.iter().map(|row| row[k]).sum::<f64>() / count;
        let square = run
            .measured
            .iter()
            .map(|row| (row[k] - mean).powi(2))
            .sum::<f64>();
        assert_near(mean, expected, 5.0 * deviation / count.sqrt(), "mean");
        let found = (square / count).sqrt();
        assert_near(found / deviation, 1.0, 0.08, "deviation");
    };
    let (center, ..) = whole();
    spread(0, point[0] - center, noise.0);
    spread(1, point[1], noise.0);
    spread(2, 0.0, noise.1);
    // The platform itself is not moved by being watched.
    assert!(run.actual.iter().all(|row| row[2].abs() < 1e-12));
}

#[test]
fn an_unstable_loop_is_reported() {
    let player = held(20.0);
    let mut platform = player.platform().clone();
    platform.controller.bandwidth = 3000.0;
    platform.actuator.delay = 0.02;
    platform.encoder.position_noise = 1e-4;
    let error = player.on(platform).run(0).unwrap_err();
    assert!(matches!(error, SimulateError::Stuck { .. }), "{error}");
}
