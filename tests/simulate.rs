//! The ground platform against motions in closed form and against the plan it plays.

mod problems;
mod trees;

use fastrand::Rng;
use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::dynamics::Model;
use ffsm_ipopt::nalgebra::{Vector2, Vector3};
use ffsm_ipopt::planner::{Momentum, Problem, plan};
use ffsm_ipopt::simulate::dynamics::{PlanarDynamics, Wrench};
use ffsm_ipopt::simulate::fit::{Experiments, Measured, Parameter, Scale, Unknown};
use ffsm_ipopt::simulate::plane::PlanarBodies;
use ffsm_ipopt::simulate::{Figures, Law, Pad, Platform, Player, Run, SimulateError};
use ffsm_ipopt::transcription::Discretization;
use ffsm_ipopt::verify::bodies::{BaseMotion, Bodies};
use ffsm_ipopt::verify::mass_matrix::{BASE, MassMatrix};
use problems::{relaxed, smooth, two_link};

/// A bandwidth at which joints hardly give, rad/s.
const STIFF: f64 = 400.0;

/// A plan of the two-link arm that holds its joints for `duration` seconds.
fn held(duration: f64) -> Player {
    let problem = Problem::new("held", two_link(), duration, &[0.0; 2], &[0.0; 2]);
    let mesh = Mesh::uniform(1, 2).unwrap();
    let plan = Discretization::sample(mesh, duration, 5, 2, |_, _, _| {});
    Player::new(&problem, &plan, Platform::default()).unwrap()
}

/// Mass centre of the held arm in the base frame, m, its mass, kg, and inertia about it, kg m².
fn whole() -> (f64, f64, f64) {
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

fn run(player: &Player, change: impl FnOnce(&mut Platform)) -> Run {
    let mut platform = player.platform().clone();
    change(&mut platform);
    player.on(platform).run(0).unwrap()
}

/// Displacement x and turn at every frame.
fn moved(run: &Run) -> impl Iterator<Item = (f64, f64, f64)> {
    let start = run.actual[0];
    run.t
        .iter()
        .zip(&run.actual)
        .map(move |(t, now)| (*t, now[0] - start[0], now[2] - start[2]))
}

fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!(
        (found - expected).abs() < tolerance,
        "{what}: {found}, expected {expected}"
    );
}

#[test]
fn an_undisturbed_platform_reproduces_the_planned_base_motion() {
    let mut tumbling = smooth();
    tumbling.task.initial_momentum = Momentum {
        linear: vec![0.02, -0.01],
        angular: vec![0.01],
    };
    for mut problem in [relaxed(), smooth(), tumbling] {
        problem.mesh.tolerance = 1e-5;
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

#[test]
fn a_tilted_floor_accelerates_the_whole_and_does_not_turn_it() {
    let (tilt, gravity) = (2e-4_f64, 9.80665);
    let run = run(&held(10.0), |platform| {
        platform.floor.tilt = [tilt, -0.5 * tilt]
    });
    for (t, x, turn) in moved(&run) {
        assert_near(x, 0.5 * gravity * tilt.sin() * t * t, 1e-10, "slide");
        assert_near(turn, 0.0, 1e-10, "turn");
    }
    let y = run.actual.last().unwrap()[1] - run.actual[0][1];
    assert_near(
        y,
        -50.0 * gravity * (0.5 * tilt).sin(),
        1e-9,
        "slide across",
    );
}

#[test]
fn the_air_film_slows_exponentially() {
    let (center, mass, _) = whole();
    let (speed, drag) = (0.05, 2.0);
    let run = run(&held(10.0), |platform| {
        platform.release.velocity = [speed, 0.0];
        platform.bearing.film_drag = drag;
        // One pad under the mass centre of the whole, so that it does not turn.
        platform.pads = vec![Pad {
            body: 0,
            at: [center, 0.0, 0.0],
            load: None,
        }];
    });
    for (t, x, turn) in moved(&run) {
        let rate = drag / mass;
        assert_near(x, speed / rate * (1.0 - (-rate * t).exp()), 1e-9, "slide");
        assert_near(turn, 0.0, 1e-9, "turn");
    }
}

#[test]
fn bearing_friction_stops_the_platform() {
    let (speed, friction, gravity) = (0.01, 1e-4, 9.80665);
    let run = run(&held(15.0), |platform| {
        platform.release.velocity = [0.6 * speed, 0.8 * speed];
        platform.bearing.friction = friction;
        platform.bearing.slip_speed = 1e-6;
    });
    // Every body is carried under its mass centre, so that friction does not turn the whole.
    let deceleration = friction * gravity;
    let stop = speed / deceleration;
    for (t, x, turn) in moved(&run) {
        let t = t.min(stop);
        let expected = 0.6 * (speed * t - 0.5 * deceleration * t * t);
        assert_near(x, expected, 1e-6, &format!("slide at {t}"));
        assert_near(turn, 0.0, 1e-8, "turn");
    }
    assert!(stop < 11.0);
}

#[test]
fn pads_on_a_circle_brake_a_turning_base() {
    let (_, _, inertia) = whole();
    let (rate, drag, radius) = (0.02, 0.5, 0.3);
    let (center, ..) = whole();
    let run = run(&held(5.0), |platform| {
        platform.release.rate = rate;
        // The arm is turned by its joints: they have to be stiff.
        platform.controller.bandwidth = STIFF;
        platform.bearing.film_drag = drag;
        // Two pads about the mass centre of the whole, which then does not move.
        platform.pads = [radius, -radius]
            .map(|r| Pad {
                body: 0,
                at: [center, r, 0.0],
                load: None,
            })
            .to_vec();
    });
    let decay = 2.0 * drag * radius * radius / inertia;
    for (t, _, turn) in moved(&run) {
        assert_near(
            turn,
            rate / decay * (1.0 - (-decay * t).exp()),
            1e-5,
            "turn",
        );
    }
}

#[test]
fn air_drag_slows_by_the_square_of_the_speed() {
    let (_, mass, _) = whole();
    let (speed, area) = (0.5, 2.0);
    let run = run(&held(10.0), |platform| {
        platform.release.velocity = [speed, 0.0];
        // In proportion to the masses, so that the whole does not turn.
        platform.air.drag_area = [15.20, 1.70, 1.20].map(|m| area * m / mass).to_vec();
    });
    let decay = 0.5 * 1.2 * area / mass;
    for (t, x, turn) in moved(&run) {
        assert_near(x, (1.0 + decay * speed * t).ln() / decay, 1e-9, "slide");
        assert_near(turn, 0.0, 1e-9, "turn");
    }
}

#[test]
fn the_umbilical_is_a_damped_spring() {
    let (center, mass, inertia) = whole();
    let (speed, stiffness, damping) = (0.02, 5.0, 1.5);
    let spring = |platform: &mut Platform| {
        platform.umbilical.at = [center, 0.0, 0.0];
        platform.release.velocity = [speed, 0.0];
        platform.umbilical.stiffness = stiffness;
    };
    let player = held(30.0);
    let omega = (stiffness / mass).sqrt();
    for (t, x, turn) in moved(&run(&player, spring)) {
        assert_near(x, speed / omega * (omega * t).sin(), 1e-8, "swing");
        assert_near(turn, 0.0, 1e-8, "turn");
    }
    let damped = run(&player, |platform| {
        spring(platform);
        platform.umbilical.damping = damping;
    });
    let decay = 0.5 * damping / mass;
    let omega = (stiffness / mass - decay * decay).sqrt();
    for (t, x, _) in moved(&damped) {
        let expected = speed / omega * (-decay * t).exp() * (omega * t).sin();
        assert_near(x, expected, 1e-8, "damped swing");
    }
    // Pulled to a point beside the start it swings about that point.
    let pulled = run(&player, |platform| {
        platform.umbilical.at = [center, 0.0, 0.0];
        platform.umbilical.stiffness = stiffness;
        platform.umbilical.anchor = Some([0.01, 0.0]);
    });
    let omega = (stiffness / mass).sqrt();
    for (t, x, _) in moved(&pulled) {
        assert_near(x, 0.01 * (1.0 - (omega * t).cos()), 1e-8, "pulled swing");
    }
    let (rate, torsion) = (0.05, 0.4);
    let twisted = run(&player, |platform| {
        platform.release.rate = rate;
        platform.umbilical.torsion = torsion;
        platform.controller.bandwidth = STIFF;
    });
    let omega = (torsion / inertia).sqrt();
    for (t, _, turn) in moved(&twisted) {
        assert_near(turn, rate / omega * (omega * t).sin(), 3e-5, "twist");
    }
}

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
    let problem = Problem::new("space", model, 5.0, &[0.0; 3], &[0.0; 3]);
    let mesh = Mesh::uniform(1, 2).unwrap();
    let plan = Discretization::sample(mesh, 5.0, 9, 3, |_, _, _| {});
    let error = Player::new(&problem, &plan, Platform::default()).unwrap_err();
    assert!(matches!(error, SimulateError::NotPlanar { .. }), "{error}");
    assert_eq!(error.to_string().lines().count(), 1);

    let other = Problem::new("other", two_link(), 5.0, &[0.0; 2], &[0.0; 2]);
    let error = Player::new(&other, &plan, Platform::default()).unwrap_err();
    assert!(matches!(error, SimulateError::Plan(_)), "{error}");
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

#[test]
fn a_fit_finds_the_platform_that_was_measured() {
    let mut problem = smooth();
    problem.mesh.tolerance = 1e-3;
    let plan = plan(&problem).unwrap();
    let player = Player::new(&problem, &plan.discretization, Platform::default()).unwrap();
    let unknown = |key: &str, range: [f64; 2]| Unknown {
        parameter: Parameter::find(key).unwrap(),
        range,
        each: false,
    };
    let unknowns = [
        unknown("payload.inertia", [0.0, 0.5]),
        unknown("capture.point[1]", [-0.4, 0.4]),
    ];
    let truth = [0.12, 0.25];
    let mut hidden = Platform::default();
    hidden.payload.inertia = truth[0];
    hidden.capture.point[1] = truth[1];
    let figures = Figures::measured(&player.on(hidden).run(0).unwrap());
    let measured = |attitude: f64| Measured {
        name: "test".into(),
        max_attitude: Some(figures.max_attitude),
        final_attitude: Some(attitude),
        final_displacement: Some(figures.final_displacement.map(f64::abs)),
    };
    let scale = Scale {
        attitude: 1f64.to_radians(),
        length: 0.01,
    };
    let fit = |attitude: f64| {
        let experiment = (player.clone(), measured(attitude));
        Experiments::new(vec![experiment], scale)
            .fit(&Platform::default(), &unknowns, 2, &|| false)
            .unwrap()
    };
    let found = fit(figures.final_attitude.abs());
    assert!(found.start_residual > 1.0, "{}", found.start_residual);
    assert!(found.residual < 0.02, "{found:?}");
    for (fitted, truth) in found.parameters.iter().zip(truth) {
        assert_near(fitted.value, truth, 5e-3, fitted.parameter.key);
    }
    // What is found with fewer numbers is not missed with more, whatever the start.
    let experiment = (player.clone(), measured(figures.final_attitude.abs()));
    let experiments = Experiments::new(vec![experiment], scale);
    let hypotheses = [unknowns.to_vec(), unknowns[..1].to_vec()];
    let fits = experiments
        .fit_each(&Platform::default(), &hypotheses, 1, &|| false)
        .unwrap();
    assert!(fits[0].residual <= fits[1].residual, "{fits:?}");
    assert_eq!(fits[1].parameters.len(), 1);
    // A final attitude above the largest cannot be: what remains is shared, not hidden.
    let impossible = fit(figures.max_attitude + 4f64.to_radians());
    assert!(impossible.residual > 1.0, "{}", impossible.residual);
    let gap = |k: usize| {
        let c = &impossible.comparisons[k];
        (c.simulated.abs() - c.measured).to_degrees()
    };
    assert!(gap(0) > 1.0 && gap(1) < -1.0, "{} {}", gap(0), gap(1));
}
