//! Mechanics without disturbances.

use crate::platforms::*;
use crate::problems::{relaxed, smooth, two_link};
use crate::trees;
use fastrand::Rng;
use ffsm_ipopt::dynamics::Model;
use ffsm_ipopt::nalgebra::{Vector2, Vector3};
use ffsm_ipopt::planner::plan;
use ffsm_ipopt::problem::Momentum;
use ffsm_ipopt::simulate::dynamics::{PlanarDynamics, Wrench};
use ffsm_ipopt::simulate::plane::PlanarBodies;
use ffsm_ipopt::simulate::{Law, Platform, Player};
use ffsm_ipopt::verify::bodies::{BaseMotion, Bodies};
use ffsm_ipopt::verify::mass_matrix::{BASE, MassMatrix};

#[test]
fn an_undisturbed_platform_reproduces_the_planned_base_motion() {
    let tumbling = smooth()
        .edited(|tumbling| {
            tumbling.task.initial_momentum = Momentum {
                linear: vec![0.02, -0.01],
                angular: vec![0.01],
            }
        })
        .unwrap();
    for problem in [relaxed(), smooth(), tumbling] {
        let problem = problem
            .edited(|problem| problem.mesh.tolerance = 1e-5)
            .unwrap();
        let plan = plan(&problem).unwrap();
        for law in [Law::ComputedTorque, Law::PdFeedForward] {
            let mut platform = Platform::default();
            platform.controller.law = law;
            let player = Player::new(&problem, &plan.discretization, platform).unwrap();
            let run = player.run(0).unwrap();
            let name = format!("{} by {}", problem.name, law.name());
            let planned = player.planned(&run.t);
            assert_eq!(planned.len(), 2001);
            for (k, (actual, planned)) in run.actual.iter().zip(&planned).enumerate() {
                assert_near(
                    actual[2],
                    planned[2],
                    1e-6,
                    &format!("{name}, attitude {k}"),
                );
                for i in 0..2 {
                    assert_near(
                        actual[i],
                        planned[i],
                        1e-6,
                        &format!("{name}, position {k}"),
                    );
                }
            }
            assert!(
                run.max_linear_momentum < 1e-10,
                "{name}: {}",
                run.max_linear_momentum
            );
            assert!(
                run.max_angular_momentum < 1e-10,
                "{name}: {}",
                run.max_angular_momentum
            );
            // And at the nodes it is the plan's own record.
            let last = plan.trajectory.base_position.last().unwrap();
            let end = planned.last().unwrap();
            assert_near(end[0], last[0], 1e-9, "position at the end");
            assert_near(end[1], last[1], 1e-9, "position at the end");
        }
    }
}

#[test]
fn torques_inside_the_robot_leave_momentum_alone() {
    let problem = smooth();
    let plan = plan(&problem).unwrap();
    let player = Player::new(&problem, &plan.discretization, Platform::default()).unwrap();
    let run = run(&player, |platform| {
        platform.joint_friction.coulomb = 0.02;
        platform.joint_friction.viscous = 0.05;
        platform.actuator.torque_noise = 0.01;
        platform.actuator.delay = 2.5e-3;
        platform.encoder.position_noise = 1e-5;
    });
    assert!(run.max_joint_error > 1e-4, "{}", run.max_joint_error);
    assert!(
        run.max_linear_momentum < 1e-10,
        "{}",
        run.max_linear_momentum
    );
    assert!(
        run.max_angular_momentum < 1e-10,
        "{}",
        run.max_angular_momentum
    );
}

/// The planar equations against those in space, built from other Jacobians.
#[test]
fn planar_accelerations_are_those_in_space() {
    let rng = &mut Rng::with_seed(5);
    let mut robots: Vec<Model> = (0..4).map(|_| trees::planar(rng, Vector3::z())).collect();
    robots.push(trees::planar(rng, Vector3::new(0.6, 0.0, 0.8)));
    robots.push(trees::planar(rng, -Vector3::y()));
    robots.push(two_link());
    for model in robots {
        let n = model.joint_count();
        let basis = model.plane().unwrap().basis;
        let mut planar = PlanarDynamics::new(PlanarBodies::new(&model).unwrap());
        let (q, v) = (
            trees::values(rng, 3 + n, 1.0),
            trees::values(rng, 3 + n, 1.0),
        );
        let torque = trees::values(rng, n, 1.0);
        planar.place(&q, &v);
        let mut found = vec![0.0; 3 + n];
        planar.accelerations(&vec![Wrench::ZERO; n + 1], &torque, &mut found);

        let normal = basis.column(2).into_owned();
        let base = BaseMotion {
            velocity: basis * Vector3::new(v[0], v[1], 0.0),
            angular: normal * v[2],
            ..BaseMotion::placed(
                basis * Vector3::new(q[0], q[1], 0.0),
                ffsm_ipopt::verify::bodies::orientation(
                    &model,
                    ffsm_ipopt::dynamics::attitude::SpatialAttitude::RollPitchYaw,
                    &q[2..3],
                ),
            )
        };
        let mut bodies = Bodies::new(&model);
        bodies.update(&model, &base, &q[3..], &v[3..]);
        let mut mass = MassMatrix::new(&model);
        mass.update(&model, &bodies, &v[3..]).unwrap();
        let mut expected = vec![0.0; BASE + n];
        mass.accelerations(&torque, &mut expected);
        let linear = basis.transpose() * Vector3::from_column_slice(&expected[..3]);
        let turn = normal.dot(&Vector3::from_column_slice(&expected[3..6]));
        for (k, value) in [linear.x, linear.y, turn]
            .into_iter()
            .chain(expected[BASE..].iter().copied())
            .enumerate()
        {
            assert_near(
                found[k],
                value,
                1e-9 * (1.0 + value.abs()),
                &format!("coordinate {k}"),
            );
        }
        // Momentum too, and the base motion that gives it.
        let center = bodies.center();
        let linear = basis.transpose() * bodies.linear_momentum();
        let angular = normal.dot(&bodies.angular_momentum());
        assert_near(planar.linear_momentum().x, linear.x, 1e-12, "momentum");
        assert_near(
            planar.angular_momentum(),
            angular,
            1e-12,
            "angular momentum",
        );
        assert_near(
            planar.center().y,
            basis.column(1).dot(&center),
            1e-12,
            "centre",
        );
        let mut still = v.clone();
        still[..3].fill(0.0);
        planar.place(&q, &still);
        let base = planar.base_velocity(&Vector2::new(linear.x, linear.y), angular);
        for k in 0..3 {
            assert_near(base[k], v[k], 1e-10, "base velocity");
        }
    }
}

#[test]
fn a_wrench_acts_where_it_is_applied() {
    let model = two_link();
    let mut planar = PlanarDynamics::new(PlanarBodies::new(&model).unwrap());
    let (center, mass, inertia) = whole();
    planar.place(&[0.0; 5], &[0.0; 5]);
    let mut wrenches = [Wrench::ZERO; 3];
    let tip = Vector2::new(1.168, 0.0);
    wrenches[2].add(&Vector2::new(0.0, 2.0), &tip, &planar.states()[2].center);
    let mut free = vec![0.0; 5];
    planar.accelerations(&wrenches, &[0.0; 2], &mut free);
    // What the whole must do whatever its joints do: Σ m a = F.
    let bodies = [15.20, 1.70, 1.20];
    let centers = [0.0, 0.520, 1.012];
    let turns = [free[2], free[2] + free[3], free[2] + free[3] + free[4]];
    let origins = [0.0, 0.156 * turns[0], 0.156 * turns[0] + 0.506 * turns[1]];
    let starts = [0.0, 0.156, 0.662];
    let momentum: f64 = (0..3)
        .map(|i| bodies[i] * (free[1] + origins[i] + (centers[i] - starts[i]) * turns[i]))
        .sum();
    assert_near(momentum, 2.0, 1e-12, "rate of momentum");
    // Joints held by the torques of a rigid body: the same force turns the whole.
    let spin = 2.0 * (tip.x - center) / inertia;
    let rise = 2.0 / mass - spin * center;
    let elbow = {
        // Moment balance of the forearm about the elbow.
        let a = rise + spin * 1.012;
        1.20 * a * 0.35 + 0.0486 * spin - 2.0 * (tip.x - 0.662)
    };
    let shoulder = {
        let (a1, a2) = (rise + spin * 0.520, rise + spin * 1.012);
        1.70 * a1 * 0.364 + 0.0590 * spin + 1.20 * a2 * 0.856 + 0.0486 * spin
            - 2.0 * (tip.x - 0.156)
    };
    planar.accelerations(&wrenches, &[shoulder, elbow], &mut free);
    for (found, expected) in free.iter().zip([0.0, rise, spin, 0.0, 0.0]) {
        assert_near(*found, expected, 1e-12, "rigid body");
    }
}
