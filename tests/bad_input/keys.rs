//! Keys that are missing or unknown.

use crate::complaints::*;

#[test]
fn unknown_key_with_its_nearest() {
    assert_eq!(
        problem("joint_velocity", "joint_velocty"),
        "case.toml:12: limits.joint_velocty: unknown key; did you mean 'joint_velocity'?"
    );
}

#[test]
fn unknown_key_with_none_near() {
    assert_eq!(
        problem("[cost]", "[objective]"),
        "case.toml:15: objective: unknown key; expected one of schema, name, robot, base, task, \
         limits, cost, mesh, solver"
    );
}

#[test]
fn missing_keys() {
    for (line, key, expected) in [
        ("schema = 1", "schema", "schema = 1"),
        (
            "robot = \"robot.toml\"",
            "robot",
            "the path of a robot file, relative to this one",
        ),
    ] {
        assert_eq!(
            problem(line, ""),
            format!("case.toml: {key}: missing; expected {expected}")
        );
    }
    assert_eq!(
        problem("final.joints = [0.5, 1.0]", ""),
        "case.toml:5: task.final: missing; expected a table with joints, the joint positions at the end, or end_effector"
    );
    assert_eq!(
        problem("duration = 20.0", ""),
        "case.toml:5: task.duration: missing; expected a finite duration above zero, s, or { min = …, max = … }"
    );
}

#[test]
fn other_schema() {
    assert_eq!(
        problem("schema = 1", "schema = 2"),
        "case.toml:1: schema: 2; expected 1, the only schema this version reads"
    );
}

#[test]
fn name_that_leaves_the_output_folder() {
    assert_eq!(
        problem("\"case\"", "\"../case\""),
        "case.toml:2: name: \"../case\"; expected at most 120 bytes of letters, digits, '-', '_', \
         '.' and spaces between them, for it names the output folder"
    );
}
