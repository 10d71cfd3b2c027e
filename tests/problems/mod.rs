//! Problems shared by the tests.
#![allow(dead_code)]

use ffsm_ipopt::dynamics::{Body, Inertia, Joint, JointKind, JointLimits, Model, Placement};
use ffsm_ipopt::nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::planner::Problem;
use std::f64::consts::PI;

/// The two-link manipulator of the paper's Table I.
pub fn two_link() -> Model {
    let body = |name: &str, mass, inertia, center| Body {
        name: name.into(),
        inertia: Inertia::new(
            mass,
            Vector3::new(center, 0.0, 0.0),
            Matrix3::identity() * inertia,
        )
        .unwrap(),
    };
    let joint = |name: &str, parent, offset, body| Joint {
        name: name.into(),
        kind: JointKind::Revolute,
        parent,
        placement: Placement::from_xyz_rpy([offset, 0.0, 0.0], [0.0; 3]),
        axis: Vector3::z_axis(),
        limits: JointLimits::NONE,
        body,
    };
    let joints = vec![
        joint("joint1", None, 0.156, body("link1", 1.70, 0.0590, 0.364)),
        joint(
            "joint2",
            Some(0),
            0.364 + 0.142,
            body("link2", 1.20, 0.0486, 0.35),
        ),
    ];
    Model::new("planar-2link", body("base", 15.20, 0.1454, 0.0), joints).unwrap()
}

/// A body of random mass properties that a real one could have.
pub fn random_body(name: &str, random: &mut fastrand::Rng) -> Body {
    let axis = Vector3::new(random.f64() - 0.5, random.f64() - 0.5, random.f64() - 0.5);
    let rotation = Rotation3::new(axis * 6.0);
    let [a, b] = [0.05 + random.f64(), 0.05 + random.f64()];
    let c = (a - b).abs() + 0.9 * random.f64() * (a + b - (a - b).abs()) + 0.01;
    let moments = Matrix3::from_diagonal(&Vector3::new(a, b, c));
    let inertia = rotation * moments * rotation.inverse();
    let center = Vector3::new(random.f64(), random.f64(), random.f64()) * 0.4;
    let mass = 1.0 + 9.0 * random.f64();
    let inertia = Inertia::new(mass, center, inertia).unwrap();
    Body {
        name: name.into(),
        inertia,
    }
}

/// A random spatial tree: joint j is carried by `parents[j]`; those in `prismatic` slide.
pub fn random_tree(parents: &[Option<usize>], prismatic: &[usize], seed: u64) -> Model {
    let mut random = fastrand::Rng::with_seed(seed);
    let base = random_body("base", &mut random);
    let joints = parents
        .iter()
        .enumerate()
        .map(|(j, &parent)| {
            let mut three = || [0; 3].map(|_| 2.0 * random.f64() - 1.0);
            let (xyz, rpy, axis) = (three(), three().map(|a| a * PI), three());
            let slides = prismatic.contains(&j);
            Joint {
                name: format!("joint{}", j + 1),
                kind: if slides {
                    JointKind::Prismatic
                } else {
                    JointKind::Revolute
                },
                parent,
                placement: Placement::from_xyz_rpy(xyz, rpy),
                axis: Unit::new_normalize(Vector3::from(axis)),
                limits: JointLimits::NONE,
                body: random_body(&format!("link{}", j + 1), &mut random),
            }
        })
        .collect();
    Model::new("random", base, joints).unwrap()
}

/// A chain of `n` random joints.
pub fn random_chain(n: usize, seed: u64) -> Model {
    let parents: Vec<Option<usize>> = (0..n).map(|j: usize| j.checked_sub(1)).collect();
    random_tree(&parents, &[], seed)
}

/// `table1-relaxed`: the published case without the bounds on the base attitude.
pub fn relaxed() -> Problem {
    let mut problem = Problem::new(
        "table1-relaxed",
        two_link(),
        20.0,
        &[0.0; 2],
        &[PI / 6.0, PI / 3.0],
    );
    let limits = &mut problem.limits;
    limits.joint_position = vec![Interval::symmetric(PI / 2.0); 2];
    limits.joint_velocity = vec![Interval::symmetric(0.9); 2];
    limits.control = vec![Interval::symmetric(5.0), Interval::symmetric(4.0)];
    limits.base_rate = vec![Interval::symmetric(0.6)];
    let cost = &mut problem.cost;
    cost.final_base_attitude = vec![1.0];
    cost.final_base_position = vec![1.0; 2];
    cost.base_rate = vec![0.6];
    cost.joint_rate = vec![0.2; 2];
    problem
}

/// `table1-smooth`: relaxed, with a weight on the control.
pub fn smooth() -> Problem {
    let mut problem = relaxed();
    problem.name = "table1-smooth".into();
    problem.cost.control = vec![0.1; 2];
    problem
}

/// `table1`: as published, infeasible.
pub fn published() -> Problem {
    let mut problem = relaxed();
    problem.name = "table1".into();
    problem.limits.base_attitude = vec![Interval::symmetric(PI / 12.0)];
    problem.limits.final_base_attitude = vec![Interval::symmetric(PI / 12.0)];
    problem
}
