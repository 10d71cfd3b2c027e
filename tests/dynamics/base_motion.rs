//! The base along a path, and its attitude.

use crate::compared::*;
use crate::problems::two_link;
use crate::trees;
use fastrand::Rng;
use ffsm_ipopt::autodiff::Dual;
use ffsm_ipopt::dynamics::attitude::{Attitude, PlanarAngle, SpatialAttitude};
use ffsm_ipopt::dynamics::{Model, Tree};
use ffsm_ipopt::nalgebra::Vector3;
use ffsm_ipopt::verify::bodies::orientation;
use std::f64::consts::PI;

/// Base attitude (rad) and displacement (m) after the straight path between joint positions.
fn straight_line(model: &Model, from: [f64; 2], to: [f64; 2]) -> (f64, [f64; 2]) {
    let tree = Tree::planar(model).unwrap();
    let dq: Vec<f64> = to.iter().zip(from).map(|(b, a)| b - a).collect();
    let at = |s: f64| evaluate(&tree, &[from[0] + s * dq[0], from[1] + s * dq[1]], &dq);
    // Simpson's rule: the rate depends on s alone.
    let steps = 1000;
    let mut eta = 0.0;
    for k in 0..=steps {
        let weight = if k == 0 || k == steps {
            1.0
        } else {
            2.0 * (1 + k % 2) as f64
        };
        eta += weight * at(k as f64 / steps as f64).base_rate.x / (3 * steps) as f64;
    }
    let start = PlanarAngle.base_position(&[0.0], &at(0.0).system_center);
    let end = PlanarAngle.base_position(&[eta], &at(1.0).system_center);
    (eta, (end - start).into())
}

#[test]
fn the_straight_path_of_table_1_moves_the_base_as_other_tools_say() {
    let (eta, [x, y]) = straight_line(&two_link(), [0.0, 0.0], [PI / 6.0, PI / 3.0]);
    assert!(
        (eta.to_degrees() + 36.648820).abs() < 5e-7,
        "{}°",
        eta.to_degrees()
    );
    assert!((100.0 * x - 1.475023).abs() < 5e-7, "{} cm", 100.0 * x);
    assert!((100.0 * y - 0.414488).abs() < 5e-7, "{} cm", 100.0 * y);
}

#[test]
fn attitude_rates_are_those_of_the_orientation() {
    // R(η + η̇ dt) − R(η) against ω, by dual numbers on the axes of the base.
    let rng = &mut Rng::with_seed(11);
    let attitudes = SpatialAttitude::ALL.into_iter().cycle();
    for attitude in attitudes.take(150) {
        let eta = trees::attitude(rng, attitude);
        let omega = trees::vector(rng);
        let mut rates = vec![0.0; eta.len()];
        attitude.rates(&eta, &omega, &mut rates);
        let moving: Vec<Dual<1>> = (0..eta.len())
            .map(|i| Dual {
                value: eta[i],
                gradient: [rates[i]],
            })
            .collect();
        let r = orientation(&trees::zoo(1)[0], attitude, &eta)
            .to_rotation_matrix()
            .into_inner();
        for k in 0..3 {
            let axis = Vector3::ith(k, 1.0);
            let turned = attitude.to_inertial(
                &moving,
                &axis.map(|c| Dual {
                    value: c,
                    gradient: [0.0],
                }),
            );
            let expected = r * omega.cross(&axis);
            assert!((turned.map(|c| c.value) - r * axis).norm() < 1e-14);
            assert!((turned.map(|c| c.gradient[0]) - expected).norm() < 1e-13);
        }
    }
}

#[test]
fn the_rotation_angle_and_the_change_of_description() {
    let rng = &mut Rng::with_seed(12);
    let robot = &trees::zoo(1)[0];
    let attitudes = SpatialAttitude::ALL.into_iter().cycle();
    for from in attitudes.take(300) {
        let eta = trees::attitude(rng, from);
        let turned = orientation(robot, from, &eta);
        let shortest = turned.angle().min(2.0 * PI - turned.angle());
        let found = from.squared_rotation_angle::<f64>(&eta).sqrt();
        assert!(
            (found - shortest).abs() < 1e-14,
            "{found} instead of {shortest}"
        );
        for to in SpatialAttitude::ALL {
            let other = to.of_quaternion(&from.to_quaternion(&eta), to.start());
            assert!(orientation(robot, to, &other).angle_to(&turned) < 1e-7);
            let back = from.of_quaternion(&to.to_quaternion(&other), &eta);
            let gap = back.iter().zip(&eta).map(|(a, b)| (a - b).abs());
            assert!(gap.fold(0.0, f64::max) < 1e-12, "{back:?} for {eta:?}");
        }
    }
    // A full turn about one axis: roll-pitch-yaw and quaternion go on, past half a turn too.
    for by in [SpatialAttitude::RollPitchYaw, SpatialAttitude::Quaternion] {
        let mut eta = by.start().to_vec();
        for k in 0..=40 {
            let angle = f64::from(k) * PI / 20.0;
            let roll = SpatialAttitude::RollPitchYaw.to_quaternion(&[angle, 0.0, 0.0]);
            eta = by.of_quaternion(&roll, &eta);
        }
        let last = match by {
            SpatialAttitude::RollPitchYaw => 2.0 * PI,
            _ => -1.0,
        };
        assert!((eta[0] - last).abs() < 1e-12, "{eta:?}");
    }
}
