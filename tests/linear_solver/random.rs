//! Random tasks: the multifrontal solver and MUMPS come to the same verdict.

use crate::problems;
use crate::trees::{REVOLUTE, random, uniform};
use fastrand::Rng;
use ffsm_ipopt::dynamics::attitude::SpatialAttitude;
use ffsm_ipopt::nlp::{Control, LinearSolver, Status};
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::planner::{Event, Planner};
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::refine;

/// A task for a random robot, its limits and its cost random too.
fn task(seed: u64) -> Problem {
    let rng = &mut Rng::with_seed(seed);
    let planar = rng.bool();
    let joints = if planar { 2 } else { rng.usize(1..4) };
    let robot = if planar {
        problems::two_link()
    } else {
        let parents: Vec<Option<usize>> = (0..joints).map(|j: usize| j.checked_sub(1)).collect();
        random(rng, &parents, &vec![REVOLUTE; joints])
    };
    let goal: Vec<f64> = (0..joints).map(|_| 1.5 * uniform(rng)).collect();
    let duration = 2.0 + 8.0 * rng.f64();
    let mut problem = Problem::builder("random", robot, duration, &vec![0.0; joints], &goal);
    if !planar {
        problem.set_attitude(
            [
                SpatialAttitude::RollPitchYaw,
                SpatialAttitude::Quaternion,
                SpatialAttitude::Mrp,
            ][rng.usize(..3)],
        );
    }
    let (_, angles) = problem.attitude_sizes();
    let rates = problem
        .limits
        .base_rate
        .len()
        .max(problem.cost.base_rate.len());
    if rng.bool() {
        problem.task.duration = Interval::new(0.3 * duration, 3.0 * duration);
        problem.cost.duration = 10_f64.powf(uniform(rng));
    }
    if rng.bool() {
        problem.limits.joint_velocity = vec![Interval::symmetric(0.3 + 2.0 * rng.f64()); joints];
    }
    if rng.bool() {
        problem.limits.control = vec![Interval::symmetric(0.2 + 5.0 * rng.f64()); joints];
    }
    if rng.u8(..3) == 0 {
        let bound = 10_f64.powf(2.0 * uniform(rng) - 1.0);
        let bound = if rng.u8(..4) == 0 { 0.0 } else { bound };
        let bounds = Interval::symmetric(bound);
        if rng.bool() {
            problem.limits.final_base_attitude = vec![bounds; angles];
        } else {
            problem.limits.base_attitude = vec![bounds; angles];
        }
    }
    problem.cost.joint_rate = vec![rng.f64(); joints];
    // Without a weight on the control the problem may be singular.
    let weight = [0.0, 1e-3, 0.1][rng.usize(..3)];
    problem.cost.control = vec![weight; joints];
    if rng.bool() {
        problem.cost.base_rate = vec![rng.f64(); rates];
    }
    problem.mesh.segments = rng.usize(2..6);
    problem.mesh.points = 4;
    problem.mesh.max_iterations = Some(1);
    problem.solver.max_iterations = 300;
    problem
        .build()
        .unwrap_or_else(|error| panic!("{seed}: {error}"))
}

/// How the first mesh ends: status, objective, iterations.
fn first_mesh(problem: &Problem, solver: LinearSolver) -> (Status, f64, u32) {
    let problem = problem
        .edited(|problem| problem.solver.linear_solver = solver)
        .unwrap();
    let mut found = None;
    let _ = Planner::new().plan_with(&problem, None, &mut |event| match event {
        Event::Refinement(refine::Event::Solved(record)) => {
            found = Some((record.nlp_status, record.objective, record.nlp_iterations));
            Control::Stop
        }
        // A diagnosis would begin.
        Event::Diagnosing { .. } => Control::Stop,
        _ => Control::Continue,
    });
    found.expect("a first mesh")
}

/// Solves the tasks of `seeds` by both; those of which they think differently.
fn disagreements(seeds: std::ops::Range<u64>) -> Vec<String> {
    let mut different = Vec::new();
    let (mut solved, count) = ([0, 0], seeds.end - seeds.start);
    for seed in seeds {
        let problem = task(seed);
        let ours = first_mesh(&problem, LinearSolver::Multifrontal);
        let mumps = first_mesh(&problem, LinearSolver::Mumps);
        for (solved, of) in solved.iter_mut().zip([ours, mumps]) {
            *solved += u32::from(of.0.is_solved());
        }
        let line = format!("{seed}: multifrontal {ours:?}, MUMPS {mumps:?}");
        println!("{line}");
        if ours.0.is_solved() != mumps.0.is_solved() {
            different.push(line);
        }
    }
    println!("of {count} solved by multifrontal, MUMPS: {solved:?}; different {different:#?}");
    different
}

#[test]
fn a_dozen_random_tasks_end_alike_with_mumps() {
    assert_eq!(disagreements(0..12), Vec::<String>::new());
}

/// Minutes, even in release.
#[test]
#[ignore = "long: make random-tasks"]
fn three_hundred_random_tasks_end_alike_with_mumps() {
    assert_eq!(disagreements(0..300), Vec::<String>::new());
}
