//! Mass properties of named bodies, given in the problem file instead of the robot's.

use crate::program::{Folder, edited};
use crate::robots::*;
use ffsm_ipopt::dynamics::Model;

/// The robot of `urdf` with `robot.bodies` as given.
fn with(urdf: &str, bodies: &str) -> Model {
    let robot = format!("{{ file = \"arm.urdf\", bodies = {{ {bodies} }} }}");
    let file = load(&folder(urdf, &robot, 2, ""));
    file.problem.into_builder().robot
}

#[test]
fn a_body_given_in_the_problem_is_as_one_in_the_robots_file() {
    for (bodies, old, new) in [
        (
            "upper = { mass = 5.5 }",
            "mass value=\"4\"",
            "mass value=\"5.5\"",
        ),
        // Behind a fixed joint.
        (
            "adapter = { mass = 2.25 }",
            "mass value=\"0.5\"",
            "mass value=\"2.25\"",
        ),
        (
            "adapter = { com = [0.01, 0, 0.07] }",
            "origin xyz=\"0 0 0.05\"",
            "origin xyz=\"0.01 0 0.07\"",
        ),
        (
            "lower = { inertia = [[0.02, 0.001, 0], [0.001, 0.06, 0], [0, 0, 0.05]] }",
            "ixx=\"0.01\" ixy=\"0\" ixz=\"0\" iyy=\"0.05\"",
            "ixx=\"0.02\" ixy=\"0.001\" ixz=\"0\" iyy=\"0.06\"",
        ),
        // A link of which the file gives no mass.
        (
            "tool0 = { mass = 1.5, com = [0, 0, 0.1], inertia = 0.01 }",
            "<link name=\"tool0\"/>",
            "<link name=\"tool0\"><inertial><origin xyz=\"0 0 0.1\"/><mass value=\"1.5\"/><inertia \
             ixx=\"0.01\" ixy=\"0\" ixz=\"0\" iyy=\"0.01\" iyz=\"0\" izz=\"0.01\"/></inertial></link>",
        ),
    ] {
        let changed = with(ARM, bodies);
        let (written, _) = read(&edited(ARM, old, new), 2);
        assert_eq!(changed, written, "{bodies}");
        assert_ne!(changed, read(ARM, 2).0, "{bodies}");
    }
}

#[test]
fn an_inertia_that_is_given_stands_in_the_axes_of_the_body() {
    // The file turns the axes of this one by 0.2 rad.
    let robot = with(ARM, "upper = { inertia = [0.02, 0.09, 0.1] }");
    let own = robot.joints()[0].body.inertia.rotational();
    assert!(
        (own.m11 - 0.02).abs() < 1e-15 && own.m13.abs() < 1e-15,
        "{own}"
    );
}

#[test]
fn a_link_without_figures_needs_both_mass_and_inertia() {
    let refused = |bodies: &str| {
        let robot = format!("{{ file = \"arm.urdf\", bodies = {{ {bodies} }} }}");
        complaint(&folder(ARM, &robot, 2, ""))
    };
    assert_eq!(
        refused("tool0 = { inertia = 0.01 }"),
        "case.toml:3: robot.bodies.tool0.mass: missing; expected a finite mass above zero, kg; \
         the robot's file gives none"
    );
    assert_eq!(
        refused("tool = { mass = 1.0 }"),
        "case.toml:3: robot.bodies.tool: unknown key; did you mean 'tool0'?"
    );
}

#[test]
fn a_body_can_be_set_on_the_command_line() {
    let folder: Folder = folder(ARM, FILE, 2, "");
    let run = folder.run(&[
        "plan",
        "case.toml",
        "--out",
        "o",
        "--quiet",
        "--set",
        "robot.bodies.adapter.mass=2.25",
    ]);
    assert_eq!(run.code, 0, "{run:?}");
    let saved: serde_json::Value = serde_json::from_str(&folder.read("o/solution.json")).unwrap();
    let options = &saved["provenance"]["problem"]["overrides"];
    assert_eq!(options[0], "--set robot.bodies.adapter.mass=2.25");
    // Planned again from the texts in the file, the robot is the same.
    assert_eq!(folder.run(&["verify", "o/solution.json"]).code, 0);
}
