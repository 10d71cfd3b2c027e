//! Pairs kept apart along the path.

mod problems;

use ffsm_ipopt::planner::{Plan, Status, plan};
use ffsm_ipopt::problem::{KeepOut, Obstacle, Problem, Sphere};

/// The two-link arm swings its elbow from one side to the other, past a mast on the base.
fn swing() -> Problem {
    problems::smooth()
        .edited(|problem| {
            problem.task.initial_joints = vec![0.9, 0.5];
            problem.task.final_joints = vec![-0.9, -0.5];
            problem.limits.joint_position = vec![ffsm_ipopt::ocp::Interval::symmetric(2.8); 2];
            problem.mesh.tolerance = 1e-3;
            problem.mesh.segments = 20;
            problem.mesh.max_iterations = 15;
        })
        .unwrap()
}

/// Joint positions at many times, far more than the mesh has nodes.
fn joints(plan: &Plan) -> Vec<[f64; 2]> {
    let mut x = vec![0.0; plan.discretization.states];
    let mut u = vec![0.0; plan.discretization.controls];
    (0..=5000)
        .map(|k| {
            let fraction = f64::from(k) / 5000.0;
            plan.discretization.at_fraction(fraction, &mut x, &mut u);
            [x[1], x[2]]
        })
        .collect()
}

/// Distances of the forearm's end from a point of the base.
fn distances(plan: &Plan, point: [f64; 2]) -> Vec<f64> {
    let tip = |q: [f64; 2]| {
        let (a, b) = (q[0], q[0] + q[1]);
        let x = 0.156 + 0.506 * a.cos() + 0.506 * b.cos();
        let y = 0.506 * a.sin() + 0.506 * b.sin();
        (x - point[0]).hypot(y - point[1])
    };
    joints(plan).into_iter().map(tip).collect()
}

fn forearm_end(radius: f64) -> Sphere {
    Sphere {
        joint: Some(1),
        center: [0.506, 0.0, 0.0],
        radius,
    }
}

const MAST: [f64; 2] = [1.0, 0.0];

/// The swing with 0.3 m kept between the forearm's end and the mast.
fn around_the_mast() -> Problem {
    swing()
        .edited(|problem| {
            problem.limits.keep_out = vec![KeepOut {
                name: "mast".into(),
                sphere: forearm_end(0.05),
                from: Obstacle::Sphere(Sphere {
                    joint: None,
                    center: [MAST[0], MAST[1], 0.0],
                    radius: 0.25,
                }),
            }]
        })
        .unwrap()
}

fn closest(plan: &Plan) -> f64 {
    let distances = distances(plan, MAST).into_iter();
    distances.fold(f64::INFINITY, f64::min)
}

/// What is left of 0.3 m where its square falls short by the tolerance of one in a thousand.
const NEAREST: f64 = 0.3 * (1.0 - 0.51e-3);

#[test]
fn the_arm_goes_around_a_sphere() {
    let free = plan(&swing()).unwrap();
    assert!(closest(&free) < 0.25, "the task would not need the limit");
    let around = plan(&around_the_mast()).unwrap();
    assert_eq!(around.status, Status::Solved, "{:?}", around.iterations);
    assert_eq!(around.warnings, [""; 0]);
    assert!(closest(&around) > NEAREST, "{}", closest(&around));
}

#[test]
fn slipping_through_between_points_is_no_solution() {
    let problem = around_the_mast()
        .edited(|problem| {
            // The error estimate is content with anything.
            problem.mesh.tolerance = 10.0;
            problem.mesh.segments = 4;
            problem.mesh.points = 4;
            problem.mesh.max_iterations = 1;
        })
        .unwrap();
    let coarse = plan(&problem).unwrap();
    assert_eq!(coarse.status, Status::NotConverged);
    assert!(coarse.max_error < problem.mesh.tolerance);
    let depth = 0.3 - closest(&coarse);
    assert!(depth > 0.05, "{depth}");
    let [warning] = &coarse.warnings[..] else {
        panic!("{:?}", coarse.warnings);
    };
    let told = warning.strip_prefix("limits.keep_out (mast) is exceeded by ");
    let told = told.and_then(|rest| rest.split_once(" m between the points of the mesh, at "));
    let (size, when) = told.expect(warning);
    let size: f64 = size.parse().unwrap();
    assert!((size - depth).abs() < 0.2 * depth, "{size} of {depth}");
    assert!(when.contains(" s; more mesh.segments"), "{warning}");
}

#[test]
fn coming_too_near_between_points_is_refined_away() {
    let problem = around_the_mast()
        .edited(|problem| {
            problem.mesh.tolerance = 10.0;
            problem.mesh.points = 4;
        })
        .unwrap();
    let refined = plan(&problem).unwrap();
    assert_eq!(refined.status, Status::Solved);
    assert_eq!(refined.warnings, [""; 0]);
    assert!(closest(&refined) > NEAREST, "{}", closest(&refined));
    // A mesh before the last was good enough for the error, not for the mast.
    let iterations = &refined.iterations;
    let before = &iterations[iterations.len() - 2];
    assert!(before.nlp_status.is_solved() && before.max_violation > 1e-3);
}

#[test]
fn the_arm_stays_out_of_a_box() {
    let problem = swing();
    let (center, half) = ([1.0, 0.0, 0.0], [0.1, 0.15, 0.2]);
    let problem = problem
        .edited(|problem| {
            problem.limits.keep_out = vec![KeepOut {
                name: "box".into(),
                sphere: forearm_end(0.05),
                from: Obstacle::Box { center, half },
            }]
        })
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Solved);
    // What is left between the points is small, and said.
    let left = plan.iterations.last().unwrap().max_violation;
    assert!(left < 5e-3, "{left}");
    assert_eq!(
        left > problem.mesh.bound_tolerance,
        !plan.warnings.is_empty()
    );
    for q in joints(&plan) {
        let (a, b) = (q[0], q[0] + q[1]);
        let x = 0.156 + 0.506 * a.cos() + 0.506 * b.cos() - center[0];
        let y = 0.506 * a.sin() + 0.506 * b.sin() - center[1];
        let outside = (x.abs() - half[0]).max(y.abs() - half[1]);
        assert!(
            outside > 0.05,
            "({x}, {y}) is inside the box and its margin"
        );
    }
}

#[test]
fn a_goal_inside_an_obstacle_is_named() {
    let problem = swing()
        .edited(|problem| {
            problem.task.final_joints = vec![0.0, 0.0];
            problem.limits.keep_out = vec![KeepOut {
                name: "wall".into(),
                sphere: forearm_end(0.0),
                from: Obstacle::Sphere(Sphere {
                    joint: None,
                    center: [1.168, 0.0, 0.0],
                    radius: 0.6,
                }),
            }];
            problem.mesh.segments = 4;
            problem.mesh.points = 4;
            problem.mesh.max_iterations = 1;
        })
        .unwrap();
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Infeasible, "{:?}", plan.iterations);
    let limits = plan.diagnosis.unwrap().limits;
    assert!(
        limits.iter().any(|l| l.limit.key() == "limits.keep_out"),
        "{limits:?}"
    );
}
