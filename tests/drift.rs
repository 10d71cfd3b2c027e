//! Systems that start with momentum.

mod problems;
mod trees;

use ffsm_ipopt::planner::{Problem, Status, plan};
use ffsm_ipopt::verify::verify;

#[test]
fn a_still_arm_tumbles_and_drifts_as_one_body() {
    let mut problem = problems::smooth();
    problem.task.final_joints = problem.task.initial_joints.clone();
    problem.limits.control = vec![ffsm_ipopt::ocp::Interval::FREE; 2];
    problem.cost.final_base_attitude = vec![0.0];
    problem.cost.final_base_position = vec![0.0; 2];
    problem.cost.base_rate = vec![0.0];
    problem.cost.joint_rate = vec![1e3; 2];
    problem.task.initial_momentum.linear = vec![0.9, -0.4];
    problem.task.initial_momentum.angular = vec![0.05];
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
    let mut problem = Problem::new("pitching", trees::chain(3, 12), 8.0, &[0.0; 3], &[0.1; 3]);
    problem.cost.joint_rate = vec![1.0; 3];
    problem.cost.control = vec![0.1; 3];
    problem.mesh.max_iterations = 1;
    problem.solver.max_iterations = 60;
    let calm = plan(&problem).unwrap();
    assert!(calm.warnings.is_empty(), "{:?}", calm.warnings);
    // Momentum about y turns the base over in a few seconds.
    problem.task.initial_momentum.angular = vec![0.0, 8.0, 0.0];
    let turned = plan(&problem).unwrap();
    assert!(
        turned
            .warnings
            .iter()
            .any(|w| w.contains("roll-pitch-yaw is singular")),
        "{:?}",
        turned.warnings
    );
}

#[test]
fn plans_with_momentum_are_what_the_full_dynamics_do() {
    let mut plane = problems::smooth();
    plane.task.initial_momentum.linear = vec![0.3, 0.2];
    plane.task.initial_momentum.angular = vec![-0.02];
    plane.mesh.tolerance = 1e-6;
    let mut space = Problem::new("tumbling", trees::chain(4, 12), 8.0, &[0.0; 4], &[0.5; 4]);
    space.cost.joint_rate = vec![1.0; 4];
    space.cost.control = vec![0.1; 4];
    space.task.initial_momentum.linear = vec![0.5, -0.2, 0.1];
    space.task.initial_momentum.angular = vec![0.3, 0.2, -0.4];
    space.mesh.tolerance = 1e-6;
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
