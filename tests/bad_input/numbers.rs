//! Types and numbers.

use crate::complaints::*;
use crate::program::{Folder, PROBLEM};

#[test]
fn wrong_types() {
    for (old, new, line, expected) in [
        (
            "0.9",
            "\"0.9\"",
            12,
            "limits.joint_velocity: a string (\"0.9\"); expected a number, [lo, hi], or one of those a joint",
        ),
        (
            "20.0",
            "true",
            6,
            "task.duration: true; expected a finite duration above zero, s, or { min = …, max = … }",
        ),
        (
            "[0.5, 1.0]",
            "1.0",
            8,
            "task.final.joints: 1.0; expected an array of 2, one a joint: shoulder, elbow",
        ),
        (
            "segments = 4",
            "segments = 4.5",
            21,
            "mesh.segments: 4.5; expected a whole number from 1 to 100000",
        ),
        (
            "1e-3",
            "2024-01-01",
            23,
            "mesh.tolerance: a date; expected a finite number above zero",
        ),
        (
            "\"robot.toml\"",
            "3",
            3,
            "robot: 3; expected the path of a robot file, or a table with the keys file, lock and end_effector",
        ),
        (
            "joint_rate = 0.2",
            "joint_rate = []",
            17,
            "cost.joint_rate: 0 values; expected 2, one a joint: shoulder, elbow",
        ),
    ] {
        assert_eq!(problem(old, new), format!("case.toml:{line}: {expected}"));
    }
}

#[test]
fn nan_is_never_a_value() {
    for (assignment, expected) in [
        (
            "task.duration=nan",
            "task.duration: nan; expected a finite duration above zero, s, or { min = …, max = … }",
        ),
        (
            "limits.control=nan",
            "limits.control: nan; expected a bound of zero or above (inf for none), or [lo, hi]",
        ),
        (
            "limits.control=[-1.0, nan]",
            "limits.control: [-1.0, nan]; expected [lo, hi] with lo not above hi, or bounds above zero",
        ),
        (
            "limits.control=[nan, nan]",
            "limits.control[0]: nan; expected a bound of zero or above (inf for none), or [lo, hi]",
        ),
        (
            "cost.joint_rate=nan",
            "cost.joint_rate: nan; expected a finite weight, zero or above",
        ),
        (
            "task.final.joints=[nan, 0]",
            "task.final.joints[0]: nan; expected a finite number",
        ),
        (
            "mesh.tolerance=nan",
            "mesh.tolerance: nan; expected a finite number above zero",
        ),
    ] {
        assert_eq!(set(assignment), expected);
    }
}

#[test]
fn infinity_is_for_limits_only() {
    for (assignment, expected) in [
        (
            "task.duration=inf",
            "task.duration: inf; expected a finite duration above zero, s, or { min = …, max = … }",
        ),
        (
            "task.duration={min=1.0,max=inf}",
            "task.duration.max: inf; expected a finite duration above zero, s",
        ),
        (
            "cost.control=inf",
            "cost.control: inf; expected a finite weight, zero or above",
        ),
        (
            "task.initial.joints=[inf, 0]",
            "task.initial.joints[0]: inf; expected a finite number",
        ),
        (
            "limits.control=-inf",
            "limits.control: -inf; expected a bound of zero or above (inf for none), or [lo, hi]",
        ),
        (
            "limits.base_rate=[inf, inf]",
            "limits.base_rate: [inf, inf]; expected [lo, hi] with lo not above hi, or bounds above zero",
        ),
    ] {
        assert_eq!(set(assignment), expected);
    }
}

#[test]
fn negative_and_zero() {
    for (assignment, expected) in [
        (
            "mesh.segments=0",
            "mesh.segments: 0; expected a whole number from 1 to 100000",
        ),
        (
            "mesh.points=0",
            "mesh.points: 0; expected a whole number from 1 to 1000",
        ),
        (
            "mesh.points=-1",
            "mesh.points: -1; expected a whole number from 1 to 1000",
        ),
        (
            "mesh.max_iterations=0",
            "mesh.max_iterations: 0; expected a whole number from 1 to 100000",
        ),
        (
            "mesh.tolerance=-1e-5",
            "mesh.tolerance: -1e-5; expected a finite number above zero",
        ),
        (
            "task.duration=-20",
            "task.duration: -20; expected a finite duration above zero, s, or { min = …, max = … }",
        ),
        (
            "task.duration=0",
            "task.duration: 0; expected a finite duration above zero, s, or { min = …, max = … }",
        ),
        (
            "task.duration={min=5,max=2}",
            "task.duration: min 5 above max 2; expected min not above max",
        ),
        (
            "cost.joint_rate=-0.2",
            "cost.joint_rate: -0.2; expected a finite weight, zero or above",
        ),
        (
            "solver.tolerance=0",
            "solver.tolerance: 0; expected a finite number above zero",
        ),
    ] {
        assert_eq!(set(assignment), expected);
    }
    let folder = Folder::new(PROBLEM);
    assert_eq!(
        complaint(&folder, &["--tolerance", "-1"]),
        "--tolerance -1.0: mesh.tolerance: -1.0; expected a finite number above zero"
    );
}
