//! Systems that start with momentum.

mod problems;
mod trees;

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::planner::{Plan, Status, plan};
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::system::{straight_line, straight_motion};
use ffsm_ipopt::verify::verify;

#[test]
fn a_still_arm_tumbles_and_drifts_as_one_body() {
    let problem = problems::smooth()
        .edited(|problem| {
            problem.task.final_joints = problem.task.initial_joints.clone();
            problem.limits.control = vec![Interval::FREE; 2];
            problem.cost.final_base_attitude = vec![0.0];
            problem.cost.final_base_position = vec![0.0; 2];
            problem.cost.base_rate = vec![0.0];
            problem.cost.joint_rate = vec![1e3; 2];
            problem.task.initial_momentum.linear = vec![0.9, -0.4];
            problem.task.initial_momentum.angular = vec![0.05];
        })
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Solved);
    // Stretched out, about the mass centre.
    let bodies = [
        (15.2, 0.1454, 0.0),
        (1.7, 0.059, 0.52),
        (1.2, 0.0486, 1.012),
    ];
    let mass: f64 = bodies.iter().map(|b| b.0).sum();
    let center = bodies.iter().map(|b| b.0 * b.2).sum::<f64>() / mass;
    let inertia: f64 = bodies
        .iter()
        .map(|b| b.1 + b.0 * (b.2 - center).powi(2))
        .sum();
    let turned = plan.trajectory.base_attitude.last().unwrap()[0];
    assert!(
        (turned - 0.05 / inertia * 20.0).abs() < 1e-5,
        "turned by {turned}"
    );
    let base = plan.trajectory.base_position.last().unwrap();
    let expected = [
        0.9 / mass * 20.0 - center * turned.cos(),
        -0.4 / mass * 20.0 - center * turned.sin(),
    ];
    assert!((base[0] - expected[0]).abs() < 1e-9 && (base[1] - expected[1]).abs() < 1e-9);
}

#[test]
fn a_base_that_pitches_to_the_singularity_is_told_of() {
    let mut problem = Problem::builder("pitching", trees::chain(3, 12), 8.0, &[0.0; 3], &[0.1; 3]);
    problem.cost.joint_rate = vec![1.0; 3];
    problem.cost.control = vec![0.1; 3];
    problem.mesh.max_iterations = Some(1);
    problem.solver.max_iterations = 60;
    let problem = problem.build().unwrap();
    let calm = plan(&problem).unwrap();
    assert!(calm.warnings.is_empty(), "{:?}", calm.warnings);
    // Momentum about y turns the base over in a few seconds.
    let problem = problem
        .edited(|problem| problem.task.initial_momentum.angular = vec![0.0, 8.0, 0.0])
        .unwrap();
    let turned = plan(&problem).unwrap();
    assert!(
        turned
            .warnings
            .iter()
            .any(|w| w.contains("roll-pitch-yaw is singular") && w.contains("base.attitude")),
        "{:?}",
        turned.warnings
    );
}

#[test]
fn plans_with_momentum_are_what_the_full_dynamics_do() {
    let plane = problems::smooth()
        .edited(|plane| {
            plane.task.initial_momentum.linear = vec![0.3, 0.2];
            plane.task.initial_momentum.angular = vec![-0.02];
            plane.mesh.tolerance = 1e-6;
        })
        .unwrap();
    let mut space = Problem::builder("tumbling", trees::chain(4, 12), 8.0, &[0.0; 4], &[0.5; 4]);
    space.cost.joint_rate = vec![1.0; 4];
    space.cost.control = vec![0.1; 4];
    space.task.initial_momentum.linear = vec![0.5, -0.2, 0.1];
    space.task.initial_momentum.angular = vec![0.3, 0.2, -0.4];
    space.mesh.tolerance = 1e-6;
    let space = space.build().unwrap();
    for problem in [plane, space] {
        let plan = plan(&problem).unwrap();
        assert_eq!(plan.status, Status::Solved, "{}", problem.name);
        let found = verify(&problem, &plan.discretization).unwrap();
        assert!(found.replay_base_attitude_drift < 1e-6, "{found:?}");
        assert!(found.replay_base_position_drift < 1e-6, "{found:?}");
        assert!(found.max_base_attitude_drift < 1e-4, "{found:?}");
        assert!(found.max_angular_momentum < 1e-9, "{found:?}");
        assert!(found.max_linear_momentum < 1e-9, "{found:?}");
        assert!(found.max_energy_gap < 1e-9, "{found:?}");
    }
}

/// `config/tumbling.toml`, whose base pitches through 90°, with the attitude described otherwise.
fn tumbling(attitude: SpatialAttitude) -> Problem {
    let file = ProblemFile::load("config/tumbling.toml".as_ref(), &Overrides::default());
    let problem = file.unwrap().problem;
    assert_eq!(problem.attitude, SpatialAttitude::Quaternion);
    let rates = problem.limits.base_rate.clone();
    problem
        .edited(|problem| {
            problem.set_attitude(attitude);
            problem.limits.base_rate = rates;
        })
        .unwrap()
}

#[test]
fn a_base_that_turns_over_by_quaternion_and_by_rodrigues_parameters() {
    let solve = |attitude: SpatialAttitude| -> Plan {
        let problem = tumbling(attitude);
        let plan = plan(&problem).unwrap();
        assert_eq!(plan.status, Status::Solved, "{attitude:?}");
        assert_eq!(plan.warnings, Vec::<String>::new());
        let gap = (plan.objective / 0.067_156_280 - 1.0).abs();
        assert!(gap < 1e-6, "{attitude:?}: J = {}", plan.objective);
        let turned = plan.metrics.final_base_attitude.to_degrees();
        assert!((turned - 120.571).abs() < 1e-3, "turned by {turned}°");
        assert_eq!(
            plan.metrics.max_base_attitude,
            plan.metrics.final_base_attitude
        );
        let found = verify(&problem, &plan.discretization).unwrap();
        assert!(found.max_base_attitude_drift < 1e-6, "{found:?}");
        assert!(found.replay_base_position_drift < 1e-6, "{found:?}");
        plan
    };
    let [by_quaternion, by_rodrigues] =
        [SpatialAttitude::Quaternion, SpatialAttitude::Mrp].map(solve);
    let gap = (by_quaternion.objective / by_rodrigues.objective - 1.0).abs();
    assert!(gap < 1e-8, "objectives {gap:e} apart");
    let ends = [&by_quaternion, &by_rodrigues].map(|plan| {
        let found = &plan.trajectory;
        let by = found.attitude.unwrap();
        by.to_quaternion(found.base_attitude.last().unwrap())
    });
    assert!(ends[0].angle_to(&ends[1]) < 1e-7, "{ends:?}");
    // No row keeps the quaternion's length; the dynamics do.
    for eta in &by_quaternion.trajectory.base_attitude {
        let length = eta.iter().map(|q| q * q).sum::<f64>().sqrt();
        assert!(
            (length - 1.0).abs() < 1e-8,
            "length off by {:e}",
            length - 1.0
        );
    }
}

#[test]
fn a_base_that_turns_over_by_roll_pitch_yaw() {
    // The rates of roll and yaw run into the limit that the base itself is far from.
    let problem = tumbling(SpatialAttitude::RollPitchYaw)
        .edited(|problem| {
            problem.mesh.max_iterations = Some(1);
            problem.mesh.segments = 8;
            problem.mesh.points = 4;
        })
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert!(plan.objective > 2.0, "J = {}", plan.objective);
}

/// A base that turns over hundreds of times is no reason to fail, and its motion along the straight joint
/// path is still right.
#[test]
fn a_base_that_tumbles_for_long_has_a_start() {
    for (attitude, duration) in [
        (SpatialAttitude::Quaternion, 1e4),
        (SpatialAttitude::Quaternion, 1e7),
        (SpatialAttitude::Mrp, 1e3),
        (SpatialAttitude::Mrp, 1e5),
        (SpatialAttitude::RollPitchYaw, 1e5),
    ] {
        let problem = tumbling(attitude).edited(|problem| {
            problem.task.duration = Interval::fixed(duration);
            problem.mesh.max_iterations = Some(1);
            problem.solver.max_iterations = 3;
        });
        let problem = problem.unwrap();
        let plan = plan(&problem).unwrap();
        assert_ne!(plan.status, Status::Solved, "{attitude:?}, {duration} s");
        let straight = straight_line(&problem);
        let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        assert!(finite(&straight.base_attitude) && finite(&straight.base_displacement));
    }
    let problem = tumbling(SpatialAttitude::Quaternion);
    let end = straight_motion(&problem, 1e4, 1000).base_attitude[1000].clone();
    let fine = straight_motion(&problem, 1e4, 100_000).base_attitude[100_000].clone();
    let [end, fine] = [end, fine].map(|eta| SpatialAttitude::Quaternion.to_quaternion(&eta));
    let apart = end.angle_to(&fine);
    assert!(apart < 1e-3, "{apart} rad apart");
    // The same whatever describes it, though the base passes through the singularities of both.
    let [by_quaternion, by_rodrigues, by_angles] = [
        SpatialAttitude::Quaternion,
        SpatialAttitude::Mrp,
        SpatialAttitude::RollPitchYaw,
    ]
    .map(|attitude| {
        let motion = straight_motion(&tumbling(attitude), 1e3, 100);
        assert_eq!(motion.attitude, Some(attitude));
        attitude.to_quaternion(&motion.base_attitude[100])
    });
    assert!(by_quaternion.angle_to(&by_rodrigues) < 1e-9);
    assert!(by_quaternion.angle_to(&by_angles) < 1e-9);
}
