//! Links that are refused.

use crate::program::edited;
use crate::robots::*;
use ffsm_ipopt::nalgebra::Vector3;
use ffsm_ipopt::problem::Shape;

#[test]
fn masses_and_inertias() {
    const UPPER: &str =
        "<inertia ixx=\"0.02\" ixy=\"0.001\" ixz=\"0\" iyy=\"0.09\" iyz=\"0\" izz=\"0.1\"/>";
    for (old, new, expected) in [
        (
            "<mass value=\"4\"/>",
            "<mass value=\"-4\"/>",
            "arm.urdf:20: link 'upper' <inertial> <mass> value: \"-4\"; expected a finite mass of zero or above, kg",
        ),
        (
            "<mass value=\"4\"/>",
            "<mass value=\"nan\"/>",
            "arm.urdf:20: link 'upper' <inertial> <mass> value: \"nan\"; expected a finite mass of zero or above, kg",
        ),
        (
            "<mass value=\"4\"/>",
            "<mass value=\"1e999\"/>",
            "arm.urdf:20: link 'upper' <inertial> <mass> value: \"1e999\"; expected a finite mass of zero or above, kg",
        ),
        (
            "<mass value=\"4\"/>",
            "<mass>4</mass>",
            "arm.urdf:20: link 'upper' <inertial> <mass> value: missing; expected a finite mass of zero or above, kg",
        ),
        (
            "<mass value=\"4\"/>",
            "",
            "arm.urdf:18: link 'upper' <inertial> <mass>: missing; expected a finite mass of zero or above, kg",
        ),
        (
            "<mass value=\"4\"/>",
            "<mass value=\"0\"/>",
            "arm.urdf:21: link 'upper' <inertial> <inertia>: mass is zero but inertia is not, expected both above zero or both zero; a joint moves it, so that robot.repair needs robot.minimum_mass",
        ),
        (
            UPPER,
            "",
            "arm.urdf:18: link 'upper' <inertial> <inertia>: missing; expected ixx, ixy, ixz, iyy, iyz and izz, kg m²",
        ),
        (
            UPPER,
            "<inertia ixx=\"0.02\" iyy=\"0.09\" izz=\"0.1\"/>",
            "arm.urdf: 3 faults: (1) arm.urdf:21: link 'upper' <inertial> <inertia> ixy: missing; expected a finite number, kg m²; (2) arm.urdf:21: link 'upper' <inertial> <inertia> ixz: missing; expected a finite number, kg m²; (3) arm.urdf:21: link 'upper' <inertial> <inertia> iyz: missing; expected a finite number, kg m²",
        ),
        (
            UPPER,
            "<inertia ixx=\"x\" ixy=\"0\" ixz=\"0\" iyy=\"0.09\" iyz=\"0\" izz=\"0.1\"/>",
            "arm.urdf:21: link 'upper' <inertial> <inertia> ixx: \"x\"; expected a finite number, kg m²",
        ),
        (
            UPPER,
            "<inertia ixx=\"0.02\" ixy=\"0.05\" ixz=\"0\" iyy=\"0.09\" iyz=\"0\" izz=\"0.1\"/>",
            "arm.urdf:21: link 'upper' <inertial> <inertia>: inertia is not positive definite: its smallest principal moment is -6.032778e-3 kg m², expected above zero; too far off for robot.repair, and a joint moves it; the nearest that a body can have is 1.322e-3, 1.074e-1, 1.087e-1",
        ),
        (
            UPPER,
            "<inertia ixx=\"0.02\" ixy=\"0\" ixz=\"0\" iyy=\"0.02\" iyz=\"0\" izz=\"0.1\"/>",
            "arm.urdf:21: link 'upper' <inertial> <inertia>: inertia breaks the triangle inequality: principal moments 2.000000e-2, 2.000000e-2, 1.000000e-1 kg m², the largest may not exceed the sum of the others; too far off for robot.repair, and a joint moves it; the nearest that a body can have is 4.000e-2, 4.000e-2, 8.000e-2",
        ),
    ] {
        assert_eq!(edit(old, new), expected);
    }
}

#[test]
fn base_without_mass() {
    assert_eq!(
        complaint(&folder(WRIST, FILE, 3, "")),
        "case.toml:3: robot: base 'hull' has no mass; the base needs mass, and inertia about every \
         axis; expected a heavier root link, or a spacecraft under it: [base] with mass and inertia"
    );
}

#[test]
fn pairs_on_links_that_have_become_part_of_others() {
    // The boom is locked: `lower`, `adapter` and `tool0` are part of `upper`.
    let robot = "{ file = \"arm.urdf\", lock = { boom = 0.3 } }";
    let pairs = "\n[[limits.keep_out]]\nname = \"tool\"\n\
         sphere = { body = \"tool0\", center = [0, 0, 0.2], radius = 0.1 }\n\
         from = { body = \"hull\", center = [0, 0, -1], radius = 0.2 }\n";
    let folder = folder(ARM, robot, 1, pairs);
    let file = load(&folder);
    let sphere = &file.problem.limits.keep_out[0].first;
    assert_eq!(sphere.joint, Some(0));
    let Shape::Sphere { center, .. } = sphere.shape else {
        panic!("{sphere:?}");
    };
    // The tool's z axis is the arm's x axis.
    let expected = [0.5 + 0.3 + 0.4 + 0.1 + 0.2, 0.0, 0.0];
    assert_near(&Vector3::from(center), expected);
    let check = folder.run(&["check", "case.toml"]).stdout;
    assert!(check.contains("  end effector        tool0\n"), "{check}");
    let line =
        "    kept apart        tool: a sphere of 10 cm on upper from a sphere of 20 cm on hull";
    assert!(check.contains(line), "{check}");
    // Two links that are one body now cannot be kept apart.
    let same = edited(pairs, "\"hull\"", "\"lower\"");
    assert!(
        complaint(&self::folder(ARM, robot, 1, &same)).ends_with(
            "limits.keep_out[0].from.body: the same body; expected two different bodies"
        )
    );
    let unknown = edited(pairs, "\"tool0\"", "\"tool9\"");
    assert!(complaint(&self::folder(ARM, robot, 1, &unknown)).ends_with(
        "limits.keep_out[0].sphere.body: \"tool9\"; expected a body of the robot; did you \
             mean 'tool0'?"
    ));
}
