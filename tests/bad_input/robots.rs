//! Robots.

use crate::complaints::*;
use crate::program::{Folder, PROBLEM};

#[test]
fn masses_and_inertias() {
    for (old, new, line, expected) in [
        (
            "mass = 15.20",
            "mass = 0.0",
            11,
            "base.mass: 0.0; expected a finite mass above zero, kg",
        ),
        (
            "mass = 1.70",
            "mass = -1.70",
            18,
            "joints[0].body.mass: -1.7; expected a finite mass above zero, kg",
        ),
        (
            "mass = 1.20",
            "mass = nan",
            24,
            "joints[1].body.mass: nan; expected a finite mass above zero, kg",
        ),
        (
            "inertia = 0.1454",
            "inertia = [0.1, 0.1]",
            12,
            "base.inertia: an array of 2 values; expected a number, [Ixx, Iyy, Izz] or a 3×3 matrix about the mass centre, kg m²",
        ),
        (
            "inertia = 0.1454",
            "inertia = -1",
            12,
            "base.inertia: inertia is not positive definite: its smallest principal moment is -1.000000e0 kg m², expected above zero; robot.repair = \"inertia\" (or --repair) takes the nearest that a body can have",
        ),
        (
            "inertia = 0.1454",
            "inertia = [[1, 0, 0], [0, 1, 0.5], [0, 0, 1]]",
            12,
            "base.inertia: inertia is not symmetric: element (2, 3) and its mirror differ by 5.000e-1 kg m²; robot.repair = \"inertia\" (or --repair) takes the nearest that a body can have",
        ),
        (
            "inertia = 0.1454",
            "inertia = [1.0, 1.0, 3.0]",
            12,
            "base.inertia: inertia breaks the triangle inequality: principal moments 1.000000e0, 1.000000e0, 3.000000e0 kg m², the largest may not exceed the sum of the others; robot.repair = \"inertia\" (or --repair) takes the nearest that a body can have",
        ),
    ] {
        assert_eq!(robot(old, new), format!("robot.toml:{line}: {expected}"));
    }
}

#[test]
fn spacecraft_without_mass() {
    let folder = Folder::new(&format!("{PROBLEM}\n[base]\nmass = 0\ninertia = 1.0\n"));
    assert_eq!(
        complaint(&folder, &[]),
        "case.toml:26: base.mass: 0; expected a finite mass above zero, kg"
    );
}

#[test]
fn joints_that_make_no_robot() {
    for (old, new, line, expected) in [
        (
            "name = \"elbow\"",
            "name = \"shoulder\"",
            21,
            "joints[1].name: \"shoulder\" is given twice; expected a name of its own",
        ),
        (
            "name = \"forearm\"",
            "name = \"upper_arm\"",
            24,
            "joints[1].body.name: \"upper_arm\" is given twice; expected a name of its own",
        ),
        (
            "parent = \"forearm\"",
            "parent = \"hand\"",
            27,
            "end_effector.parent: \"hand\"; expected a body or joint of the robot: base, upper_arm, forearm, listed before this",
        ),
        (
            "[0.506, 0.0, 0.0] }        # a_1",
            "[0.506, 0.0] }        # a_1",
            23,
            "joints[1].origin.xyz: an array of 2 values; expected an array of 3 lengths, m",
        ),
        (
            "origin = { xyz = [0.156, 0.0, 0.0] }",
            "axis = [0, 0, 0]",
            17,
            "joints[0].axis: 0, 0, 0; expected an array of 3 numbers that are not all zero",
        ),
        (
            "origin = { xyz = [0.156, 0.0, 0.0] }",
            "limits = { speed = 1.0 }",
            17,
            "joints[0].limits.speed: unknown key; expected one of position, velocity, effort",
        ),
    ] {
        assert_eq!(robot(old, new), format!("robot.toml:{line}: {expected}"));
    }
}

#[test]
fn locked_joints_end_effectors_and_bodies_that_are_not_there() {
    for (robot, expected) in [
        (
            "{ file = \"robot.toml\", lock = { wrist = 0.0 } }",
            "robot.lock.wrist: unknown key; expected one of shoulder, elbow",
        ),
        (
            "{ file = \"robot.toml\", lock = { elbow = inf } }",
            "robot.lock.elbow: inf; expected the finite position the joint is locked at, rad or m",
        ),
        (
            "{ file = \"robot.toml\", lock = { shoulder = 0.0, elbow = 0.0 } }",
            "robot.lock: robot 'planar-2link' has no joints; it needs at least one",
        ),
        (
            "{ file = \"robot.toml\", end_effector = \"tool0\" }",
            "robot.end_effector: \"tool0\"; expected a body or joint of the robot: base, upper_arm, forearm",
        ),
        (
            "{ file = \"robot.toml\", bodies = { forarm = { mass = 1.0 } } }",
            "robot.bodies.forarm: unknown key; did you mean 'forearm'?",
        ),
        (
            "{ file = \"robot.toml\", bodies = { forearm = {} } }",
            "robot.bodies.forearm: an empty table; expected mass, com or inertia",
        ),
        (
            "{ file = \"robot.toml\", bodies = { forearm = { mass = 0 } } }",
            "robot.bodies.forearm.mass: 0; expected a finite mass above zero, kg",
        ),
        (
            "{ file = \"robot.toml\", bodies = { forearm = { weight = 1 } } }",
            "robot.bodies.forearm.weight: unknown key; expected one of mass, com, inertia",
        ),
        (
            "{ file = \"robot.toml\", bodies = { forearm = { com = [0, 0, 1e12] } } }",
            "robot.bodies.forearm.com: a mass centre with a coordinate of 1e12 m, expected at most 1e9 m",
        ),
        (
            "{ file = \"robot.toml\", bodies = { forearm = { inertia = [1.0, 1.0, 3.0] } } }",
            "robot.bodies.forearm.inertia: inertia breaks the triangle inequality: principal moments 1.000000e0, 1.000000e0, 3.000000e0 kg m², the largest may not exceed the sum of the others; robot.repair = \"inertia\" (or --repair) takes the nearest that a body can have",
        ),
        (
            "{ lock = {} }",
            "robot.file: missing; expected the path of a robot file",
        ),
    ] {
        assert_eq!(
            problem("\"robot.toml\"", robot),
            format!("case.toml:3: {expected}")
        );
    }
}
