//! Pairs kept apart along the path.

mod problems;

use ffsm_ipopt::planner::{KeepOut, Obstacle, Plan, Problem, Sphere, Status, plan};

/// The two-link arm swings its elbow from one side to the other, past a mast on the base.
fn swing() -> Problem {
    let mut problem = problems::smooth();
    problem.task.initial_joints = vec![0.9, 0.5];
    problem.task.final_joints = vec![-0.9, -0.5];
    problem.limits.joint_position = vec![ffsm_ipopt::ocp::Interval::symmetric(2.8); 2];
    // Held at the collocation points alone: a coarse mesh lets the arm slip through in between,
    // and the error estimate then asks for points just there.
    problem.mesh.tolerance = 1e-3;
    problem.mesh.segments = 20;
    problem.mesh.max_iterations = 15;
    problem
}

/// Distance of the forearm's end from a point of the base, at every node.
fn distances(plan: &Plan, point: [f64; 2]) -> Vec<f64> {
    let tip = |q: &Vec<f64>| {
        let (a, b) = (q[0], q[0] + q[1]);
        let x = 0.156 + 0.506 * a.cos() + 0.506 * b.cos();
        let y = 0.506 * a.sin() + 0.506 * b.sin();
        (x - point[0]).hypot(y - point[1])
    };
    plan.trajectory.joint_position.iter().map(tip).collect()
}

fn forearm_end(radius: f64) -> Sphere {
    Sphere {
        joint: Some(1),
        center: [0.506, 0.0, 0.0],
        radius,
    }
}

#[test]
fn the_arm_goes_around_a_sphere() {
    let mast = [1.0, 0.0];
    let free = plan(&swing()).unwrap();
    let closest = |plan: &Plan| {
        distances(plan, mast)
            .into_iter()
            .fold(f64::INFINITY, f64::min)
    };
    assert!(closest(&free) < 0.25, "the task would not need the limit");
    let mut problem = swing();
    problem.limits.keep_out = vec![KeepOut {
        name: "mast".into(),
        sphere: forearm_end(0.05),
        from: Obstacle::Sphere(Sphere {
            joint: None,
            center: [mast[0], mast[1], 0.0],
            radius: 0.25,
        }),
    }];
    let around = plan(&problem).unwrap();
    assert_eq!(around.status, Status::Solved, "{:?}", around.iterations);
    // Held at the collocation points; the last node is no such point.
    assert!(closest(&around) > 0.3 - 1e-6, "{}", closest(&around));
}

#[test]
fn the_arm_stays_out_of_a_box() {
    let mut problem = swing();
    let (center, half) = ([1.0, 0.0, 0.0], [0.1, 0.15, 0.2]);
    problem.limits.keep_out = vec![KeepOut {
        name: "box".into(),
        sphere: forearm_end(0.05),
        from: Obstacle::Box { center, half },
    }];
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Solved);
    for q in &plan.trajectory.joint_position {
        let (a, b) = (q[0], q[0] + q[1]);
        let x = 0.156 + 0.506 * a.cos() + 0.506 * b.cos() - center[0];
        let y = 0.506 * a.sin() + 0.506 * b.sin() - center[1];
        let outside = (x.abs() - half[0]).max(y.abs() - half[1]);
        assert!(
            outside > 0.05 - 1e-6,
            "({x}, {y}) is inside the box and its margin"
        );
    }
}

#[test]
fn a_goal_inside_an_obstacle_is_named() {
    let mut problem = swing();
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
    let plan = plan(&problem).unwrap();
    assert_eq!(plan.status, Status::Infeasible, "{:?}", plan.iterations);
    let limits = plan.diagnosis.unwrap().limits;
    assert!(
        limits.iter().any(|l| l.key == "limits.keep_out"),
        "{limits:?}"
    );
}
