//! Nothing perturbed is the plan; one joint and rigid bodies by hand.

use crate::{chaser, motion, only, problems, run};
use ffsm_ipopt::dynamics::{Body, Inertia, Joint, JointKind, JointLimits, Model, Placement};
use ffsm_ipopt::nalgebra::{Matrix3, Rotation3, Vector3};
use ffsm_ipopt::planner::plan;
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::study::dispersion::Replays;

#[test]
fn nothing_perturbed_gives_the_figures_of_the_plan() {
    let tumbling = problems::smooth()
        .edited(|problem| {
            problem.task.initial_momentum.linear = vec![0.09, -0.04];
            problem.task.initial_momentum.angular = vec![0.02];
        })
        .unwrap();
    let problems = [
        problems::smooth(),
        tumbling,
        chaser("roll-pitch-yaw"),
        chaser("quaternion"),
        chaser("mrp"),
    ];
    for problem in problems {
        let plan = plan(&problem).unwrap().discretization;
        let replays = Replays::new(&problem, &plan, &only(&problem, &[]), 1).unwrap();
        assert!(replays.step_error() < 1e-9, "{}", replays.step_error());
        let planned = *replays.planned();
        for found in run(&replays, 9) {
            for (found, planned) in [
                (found.max_base_attitude, planned.max_base_attitude),
                (found.final_base_attitude, planned.final_base_attitude),
                (found.max_base_displacement, planned.max_base_displacement),
                (
                    found.final_base_displacement,
                    planned.final_base_displacement,
                ),
                (found.departure_angle(), 0.0),
            ] {
                let gap = (found - planned).abs();
                assert!(gap < 1e-9, "{}: {found} and {planned}", problem.name);
            }
        }
    }
}

fn body(name: &str, mass: f64, center: [f64; 3], moments: [f64; 3]) -> Body {
    let rotational = Matrix3::from_diagonal(&moments.into());
    Body {
        name: name.into(),
        inertia: Inertia::new(mass, center.into(), rotational).unwrap(),
    }
}

/// A base with one joint about z, `offset` from the base's mass centre, whose link turns about its
/// own mass centre.
fn one_joint(offset: [f64; 3], base: [f64; 3], link: [f64; 3]) -> Model {
    let joint = Joint {
        name: "joint".into(),
        kind: JointKind::Revolute,
        parent: None,
        placement: Placement::from_xyz_rpy(offset, [0.0; 3]),
        axis: Vector3::z_axis(),
        limits: JointLimits::NONE,
        body: body("link", 2.0, [0.0; 3], link),
    };
    let base = body("base", 30.0, [0.0; 3], base);
    Model::new("one-joint", base, vec![joint]).unwrap()
}

const DURATION: f64 = 7.0;

fn rest_to_rest(fraction: f64) -> f64 {
    fraction.powi(3) * (10.0 - 15.0 * fraction + 6.0 * fraction * fraction)
}

/// Around its own mass centre the link's momentum is I₁(ω₀ + θ̇): the base turns back by a part of the
/// joint's angle that does not depend on it.
#[test]
fn one_joint_turns_the_base_by_the_ratio_of_inertias() {
    let (a, turn) = (0.7, 1.3);
    let model = one_joint([a, 0.0, 0.0], [1.0, 1.0, 1.5], [0.2, 0.2, 0.3]);
    let part = |masses: [f64; 2], inertias: [f64; 2]| {
        let reduced = masses[0] * masses[1] / (masses[0] + masses[1]);
        -inertias[1] / (inertias[0] + inertias[1] + reduced * a * a)
    };
    let problem = Problem::builder("one-joint", model, DURATION, &[0.0], &[turn])
        .build()
        .unwrap();
    let nominal = part([30.0, 2.0], [1.5, 0.3]);
    let plan = motion(&problem, DURATION, |fraction| {
        let q = turn * rest_to_rest(fraction);
        (vec![nominal * q], vec![q])
    });
    let sets = [
        "body.base.inertia = fixed(130%)",
        "body.link.inertia = fixed(0.8)",
        "body.base.mass = fixed(90 %)",
        "body.link.mass = fixed(2.5)",
        "joint.joint.offset = fixed(0.02)",
    ];
    let dispersion = only(&problem, &sets);
    let replays = Replays::new(&problem, &plan, &dispersion, 3).unwrap();
    let expected = part([27.0, 2.5], [1.5 * 1.3, 0.3 * 0.8]) * turn;
    for found in run(&replays, 3) {
        assert!((found.final_base_attitude - expected.abs()).abs() < 1e-10);
        assert!((found.max_base_attitude - expected.abs()).abs() < 1e-10);
        assert!((found.departure[2] - (expected - nominal * turn)).abs() < 1e-10);
        assert_eq!(found.departure[..2], [0.0, 0.0]);
        // The mass centre of the link is on its joint: the base's swings about that of the whole.
        let arm = 2.5 * a / 29.5;
        let moved = 2.0 * arm * (0.5 * expected).sin().abs();
        // The plan has that of its own masses until then, by which no sample is corrected.
        assert!((found.final_base_displacement - moved).abs() < 1e-10);
    }
}

#[test]
fn a_still_arm_with_angular_momentum_turns_evenly_in_the_plane() {
    let problem = problems::smooth();
    let (mass, moment, inertia) = problems::two_link_composite();
    let inertia = inertia - moment * moment / mass;
    let plan = motion(&problem, 20.0, |_| (vec![0.0], vec![0.0; 2]));
    let sets = ["momentum.angular=fixed(0.9)", "momentum.linear=fixed(0.3)"];
    let replays = Replays::new(&problem, &plan, &only(&problem, &sets), 0).unwrap();
    let found = run(&replays, 1)[0];
    // Beyond half a turn the angle in the plane goes on.
    let turned = 0.9 / inertia * 20.0;
    assert!(turned > 5.0);
    assert!((found.final_base_attitude - turned).abs() < 1e-9);
    assert!((found.max_base_attitude - turned).abs() < 1e-9);
    let center = moment / mass;
    let along = 0.3 / mass * 20.0 + center * (1.0 - turned.cos());
    let across = 0.3 / mass * 20.0 - center * turned.sin();
    let moved = along.hypot(across);
    assert!((found.final_base_displacement - moved).abs() < 1e-9);
}

/// A body symmetric about z with the momentum L: R = exp(tL/I_t) exp(tλz), λ = (1/I_a − 1/I_t)L·z.
#[test]
fn a_symmetric_spacecraft_precesses_in_space() {
    let model = one_joint([0.0, 0.0, 0.4], [2.0, 2.0, 1.2], [0.3, 0.3, 0.1]).in_space();
    let problem = Problem::builder("top", model, DURATION, &[0.0], &[0.0])
        .build()
        .unwrap();
    let plan = motion(&problem, DURATION, |_| (vec![0.0; 3], vec![0.0]));
    let sets = ["momentum.angular=fixed(0.3)"];
    let replays = Replays::new(&problem, &plan, &only(&problem, &sets), 0).unwrap();
    let found = run(&replays, 1)[0];
    let across = 2.0 + 0.3 + 30.0 * 2.0 / 32.0 * 0.4 * 0.4;
    let along = 1.2 + 0.1;
    let momentum = Vector3::from_element(0.3);
    let spin = (1.0 / along - 1.0 / across) * momentum.z * DURATION;
    let turn = Rotation3::from_scaled_axis(momentum * (DURATION / across))
        * Rotation3::from_scaled_axis(Vector3::z() * spin);
    assert!((found.final_base_attitude - turn.angle()).abs() < 1e-9);
    let expected = turn.scaled_axis();
    assert!((Vector3::from(found.departure) - expected).amax() < 1e-9);
}
