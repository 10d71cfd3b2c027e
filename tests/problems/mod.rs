//! Problems shared by the tests.
#![allow(dead_code)]

use ffsm_ipopt::dynamics::{Body, Inertia, Joint, JointKind, JointLimits, Model, Placement};
use ffsm_ipopt::nalgebra::{Matrix3, Vector3};
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::problem::Problem;
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

/// Mass, first moment and moment of inertia about the base's centre of the stretched two-link
/// manipulator, from Table I: kg, kg m, kg m².
pub fn two_link_composite() -> (f64, f64, f64) {
    let bodies = [
        (15.20, 0.1454, 0.0),
        (1.70, 0.0590, 0.156 + 0.364),
        (1.20, 0.0486, 0.156 + 0.364 + 0.142 + 0.35),
    ];
    bodies
        .iter()
        .fold((0.0, 0.0, 0.0), |(m, s, i), &(mass, own, at)| {
            (m + mass, s + mass * at, i + own + mass * at * at)
        })
}

/// `table1-relaxed`: the published case without the bounds on the base attitude.
pub fn relaxed() -> Problem {
    let mut problem = Problem::builder(
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
    problem.build().unwrap()
}

/// `table1-smooth`: relaxed, with a weight on the control.
pub fn smooth() -> Problem {
    relaxed()
        .edited(|problem| {
            problem.name = "table1-smooth".into();
            problem.cost.control = vec![0.1; 2];
        })
        .unwrap()
}

/// `table1`: as published, infeasible.
pub fn published() -> Problem {
    relaxed()
        .edited(|problem| {
            problem.name = "table1".into();
            problem.limits.base_attitude = vec![Interval::symmetric(PI / 12.0)];
            problem.limits.final_base_attitude = vec![Interval::symmetric(PI / 12.0)];
        })
        .unwrap()
}
