//! The paper's case: known answers of the relaxed and the smooth problem.

mod problems;

use ffsm_ipopt::nlp::Control;
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::planner::{Plan, Planner, Start, Status, plan};
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::refine::{Decision, Method};
use ffsm_ipopt::system::{at_fractions, straight_line};

#[test]
fn straight_joint_path_turns_the_base() {
    // Pinocchio, SPART and MuJoCo agree on these digits.
    let line = straight_line(&problems::relaxed());
    assert!((line.base_attitude[0].to_degrees() + 36.64882).abs() < 1e-5);
    assert!((line.base_displacement[0] - 0.01475023).abs() < 1e-8);
    assert!((line.base_displacement[1] - 0.00414488).abs() < 1e-8);
}

#[test]
fn straight_joint_path_is_the_same_in_space() {
    let problem = problems::relaxed();
    let plane = straight_line(&problem);
    let (robot, goal) = (problems::two_link().in_space(), &problem.task.final_joints);
    let space = Problem::builder("space", robot, 20.0, &[0.0; 2], goal);
    let space = straight_line(&space.build().unwrap());
    assert!((plane.base_attitude[0] - space.base_attitude[2]).abs() < 1e-12);
    assert!(space.base_attitude[0].abs() < 1e-14 && space.base_attitude[1].abs() < 1e-14);
    assert!((plane.base_displacement[0] - space.base_displacement[0]).abs() < 1e-12);
}

#[test]
fn first_mesh_of_the_relaxed_case() {
    let problem = problems::relaxed()
        .edited(|problem| problem.mesh.max_iterations = Some(1))
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::NotConverged);
    assert!(
        (plan.objective - 0.4343427).abs() < 1e-6,
        "J = {}",
        plan.objective
    );
}

#[test]
fn relaxed_case_to_1e_5_within_six_meshes() {
    let plan = plan(&problems::relaxed()).unwrap();
    assert_eq!(plan.status, Status::Solved);
    assert!(plan.iterations.len() <= 6);
    assert!(plan.max_error <= 1e-5);
    assert!(
        (plan.objective - 0.4342434).abs() < 1e-6,
        "J = {}",
        plan.objective
    );
    let degrees = plan.metrics.final_base_attitude.to_degrees();
    assert!(
        (degrees - 36.550).abs() < 2e-3,
        "final base attitude {degrees}°"
    );
}

#[test]
fn smooth_case_meets_its_optimum() {
    let plan = plan(&problems::smooth()).unwrap();
    assert_eq!(plan.status, Status::Solved);
    assert!(
        (plan.objective - 0.435641534).abs() < 1e-8,
        "J = {}",
        plan.objective
    );
    let first = &plan.iterations[0];
    assert!(
        (first.max_error - 4.5e-4).abs() < 5e-6,
        "first error {}",
        first.max_error
    );
    assert!(plan.max_error <= 1e-5);
    assert!(first.decisions.iter().any(|d| *d != Decision::Keep));
}

#[test]
fn smooth_case_by_the_global_method() {
    let problem = problems::smooth()
        .edited(|problem| problem.mesh.method = Method::Global)
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Solved);
    assert!(
        (plan.objective - 0.435641534).abs() < 1e-8,
        "J = {}",
        plan.objective
    );
    assert!(plan.iterations.iter().all(|record| record.segments == 1));
    // Twenty points already leave an error of 1.4e-4 only.
    assert!((plan.iterations[0].max_error - 1.4e-4).abs() < 1e-5);
}

#[test]
fn layers_defeat_the_global_method() {
    let problem = problems::relaxed()
        .edited(|problem| problem.mesh.method = Method::Global)
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::NotConverged);
    assert_eq!(
        plan.iterations.last().unwrap().points,
        problem.mesh.max_global_points
    );
    assert!(plan.max_error > 1e-2);
}

#[test]
fn both_forms_of_the_dynamics_plan_the_same() {
    let plane = plan(&problems::smooth()).unwrap();
    let robot = problems::two_link().in_space();
    let spatial = Problem::builder("space", robot, 20.0, &[0.0; 2], &[0.0; 2]);
    let yaw_only = |value: f64| vec![0.0, 0.0, value];
    let problem = problems::smooth()
        .edited(|problem| {
            problem.robot = spatial.robot;
            problem.cost.final_base_attitude = yaw_only(1.0);
            problem.cost.base_rate = yaw_only(0.6);
            problem.cost.final_base_position = vec![1.0, 1.0, 0.0];
            problem.limits.base_attitude = spatial.limits.base_attitude;
            problem.limits.final_base_attitude = spatial.limits.final_base_attitude;
            problem.limits.base_rate = spatial.limits.base_rate;
            problem.limits.base_position = spatial.limits.base_position;
            problem.cost.base_position = spatial.cost.base_position;
            problem.cost.base_attitude = spatial.cost.base_attitude;
            problem.task.initial_momentum = spatial.task.initial_momentum;
            problem.task.initial_base_attitude = spatial.task.initial_base_attitude;
        })
        .unwrap();
    let space = plan(&problem).unwrap();
    assert_eq!(space.status, Status::Solved);
    assert!((plane.objective - space.objective).abs() < 1e-9);
}

#[test]
fn a_saved_solution_starts_the_next_plan() {
    let problem = problems::smooth()
        .edited(|problem| problem.mesh.tolerance = 1e-3)
        .unwrap();
    let mut planner = Planner::new();
    let cold = planner.plan(&problem).unwrap();
    let start = Start {
        trajectory: cold.discretization.clone(),
        iterate: Some(cold.iterate.clone()),
    };
    let warm = planner
        .plan_with(&problem, Some(&start), &mut |_| Control::Continue)
        .unwrap();
    assert!((warm.objective - cold.objective).abs() < 1e-9);
    assert!(warm.iterations[0].nlp_iterations < cold.iterations[0].nlp_iterations);
}

/// Solver iterations on all meshes.
fn effort(plan: &Plan) -> u32 {
    plan.iterations.iter().map(|r| r.nlp_iterations).sum()
}

fn saved(plan: &Plan) -> Start {
    Start {
        trajectory: plan.discretization.clone(),
        iterate: Some(plan.iterate.clone()),
    }
}

#[test]
fn a_replan_takes_under_half_the_iterations_of_a_cold_one() {
    for problem in [problems::smooth(), problems::relaxed()] {
        let mut planner = Planner::new();
        let start = saved(&planner.plan(&problem).unwrap());
        for degrees in [[0.0, 5.0], [5.0, 5.0], [-5.0, -5.0]] {
            let moved = problem.edited(|moved| {
                for (goal, by) in moved.task.final_joints.iter_mut().zip(degrees) {
                    *goal += f64::to_radians(by);
                }
            });
            let moved = moved.unwrap();
            let cold = planner.plan(&moved).unwrap();
            let warm = planner
                .plan_with(&moved, Some(&start), &mut |_| Control::Continue)
                .unwrap();
            assert_eq!(warm.status, Status::Solved);
            assert!((warm.objective - cold.objective).abs() < 1e-6);
            let (warm, cold) = (effort(&warm), effort(&cold));
            assert!(
                2 * warm < cold,
                "{}, {degrees:?}: {warm} of {cold}",
                moved.name
            );
        }
    }
}

#[test]
fn multipliers_are_taken_over_by_a_problem_with_other_rows() {
    let problem = problems::smooth();
    let mut planner = Planner::new();
    let start = saved(&planner.plan(&problem).unwrap());
    let limited = problem
        .edited(|limited| limited.limits.torque = vec![Interval::symmetric(1.0); 2])
        .unwrap();
    let primal = Start {
        iterate: None,
        ..start.clone()
    };
    let mut from = |start: &Start| {
        let plan = planner
            .plan_with(&limited, Some(start), &mut |_| Control::Continue)
            .unwrap();
        assert_eq!(plan.status, Status::Solved);
        effort(&plan)
    };
    let (warm, cold) = (from(&start), from(&primal));
    assert!(2 * warm <= cold, "{warm} of {cold}");
}

#[test]
fn a_planner_plans_different_problems_in_a_row() {
    let mut planner = Planner::new();
    for problem in [problems::smooth(), problems::relaxed(), problems::smooth()] {
        let kept = planner.plan(&problem).unwrap();
        let fresh = plan(&problem).unwrap();
        assert_eq!(kept.objective, fresh.objective, "{}", problem.name);
    }
}

#[test]
fn the_monitor_stops_a_plan_and_keeps_what_there_is() {
    let mut seen = 0;
    let plan = Planner::new()
        .plan_with(&problems::relaxed(), None, &mut |_| {
            seen += 1;
            if seen > 5 {
                Control::Stop
            } else {
                Control::Continue
            }
        })
        .unwrap();
    assert_eq!(plan.status, Status::Interrupted);
    assert_eq!(plan.trajectory.t.len(), 51);
}

#[test]
fn a_motion_sampled_at_its_nodes_is_that_at_its_nodes() {
    let problem = problems::smooth();
    let plan = plan(&problem).unwrap();
    let nodes = plan.discretization.mesh.node_fractions();
    let sampled = at_fractions(&problem, &plan.discretization, &nodes);
    let near = |a: &[Vec<f64>], b: &[Vec<f64>]| {
        assert_eq!(a.len(), b.len());
        for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
            assert!((a - b).abs() <= 1e-12 * (1.0 + b.abs()), "{a} {b}");
        }
    };
    let planned = &plan.trajectory;
    assert_eq!(sampled.t, planned.t);
    near(&sampled.base_attitude, &planned.base_attitude);
    near(&sampled.base_position, &planned.base_position);
    near(&sampled.base_rate, &planned.base_rate);
    near(&sampled.joint_position, &planned.joint_position);
    near(&sampled.joint_velocity, &planned.joint_velocity);
    near(&sampled.control, &planned.control);
    near(&sampled.joint_torque, &planned.joint_torque);
}
