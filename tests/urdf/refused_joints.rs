//! Joints that are refused.

use crate::program::edited;
use crate::robots::*;

#[test]
fn joints_that_cannot_be_used() {
    const SHOULDER: &str = "<limit lower=\"-2.0\" upper=\"2.5\" velocity=\"1.5\" effort=\"30\"/>";
    for (old, new, expected) in [
        (
            "\"prismatic\"",
            "\"slider\"",
            "arm.urdf:25: joint 'boom' type: \"slider\"; expected \"revolute\", \"continuous\", \"prismatic\" or \"fixed\"",
        ),
        (
            "\"prismatic\"",
            "\"planar\"",
            "arm.urdf:25: joint 'boom' type: \"planar\"; expected \"revolute\", \"continuous\", \"prismatic\" or \"fixed\"",
        ),
        (
            "\"prismatic\"",
            "\"floating\"",
            "arm.urdf:25: joint 'boom' type: \"floating\"; expected \"revolute\", \"continuous\", \"prismatic\" or \"fixed\"; only the base may float, on a root link that has no mass and no other joint",
        ),
        (
            "name=\"boom\" type=\"prismatic\"",
            "name=\"boom\"",
            "arm.urdf:25: joint 'boom' type: missing; expected \"revolute\", \"continuous\", \"prismatic\" or \"fixed\"",
        ),
        (
            "<axis xyz=\"0 0 1\"/>",
            "<axis xyz=\"0 0 0\"/>",
            "arm.urdf:14: joint 'shoulder' <axis> xyz: \"0 0 0\"; expected 3 finite numbers that are not all zero",
        ),
        (
            "<axis xyz=\"0 0 1\"/>",
            "<axis xyz=\"0 1\"/>",
            "arm.urdf:14: joint 'shoulder' <axis> xyz: \"0 1\"; expected 3 finite numbers that are not all zero",
        ),
        (
            "<axis xyz=\"0 0 1\"/>",
            "<axis/>",
            "arm.urdf:14: joint 'shoulder' <axis> xyz: missing; expected 3 finite numbers that are not all zero",
        ),
        (
            "0.3 0 0.1",
            "0.3 0 O.1",
            "arm.urdf:13: joint 'shoulder' <origin> xyz: \"0.3 0 O.1\"; expected 3 finite lengths, m",
        ),
        (
            "rpy=\"0 0 0.5\"",
            "rpy=\"0 0 nan\"",
            "arm.urdf:13: joint 'shoulder' <origin> rpy: \"0 0 nan\"; expected 3 finite angles, rad",
        ),
        (
            "rpy=\"0 0 0.5\"",
            "quat_xyzw=\"0 0 0 1\"",
            "arm.urdf:13: joint 'shoulder' <origin> quat_xyzw: \"0 0 0 1\"; expected the orientation as rpy",
        ),
        (
            SHOULDER,
            "<limit lower=\"2\" upper=\"1\"/>",
            "arm.urdf:15: joint 'shoulder' <limit>: lower 2 above upper 1; expected lower not above upper",
        ),
        (
            SHOULDER,
            "<limit lower=\"1,5\" upper=\"2\"/>",
            "arm.urdf:15: joint 'shoulder' <limit> lower: \"1,5\"; expected a number, rad or m",
        ),
        (
            SHOULDER,
            "<limit lower=\"NaN\" upper=\"2\"/>",
            "arm.urdf:15: joint 'shoulder' <limit> lower: \"NaN\"; expected a number, rad or m",
        ),
        (
            SHOULDER,
            "<limit lower=\"1\" upper=\"2\"\n velocity=\"-1\"/>",
            "arm.urdf:16: joint 'shoulder' <limit> velocity: \"-1\"; expected a number of zero or above",
        ),
        (
            SHOULDER,
            "<limit effort=\"\"/>",
            "arm.urdf:15: joint 'shoulder' <limit> effort: \"\"; expected a number of zero or above",
        ),
        (
            SHOULDER,
            "<limit/>\n<limit/>",
            "arm.urdf:16: joint 'shoulder' <limit>: given twice; expected one at most",
        ),
    ] {
        assert_eq!(edit(old, new), expected);
    }
}

#[test]
fn floating_joints_that_are_not_that_of_the_base() {
    let massive = edited(
        FLOATING,
        "<link name=\"world\"/>",
        "<link name=\"world\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial></link>",
    );
    let crowded = edited(
        FLOATING,
        "<link name=\"world\"/>",
        "<link name=\"world\"/><link name=\"sun\"/><joint name=\"s\" type=\"fixed\"><parent link=\"world\"/><child link=\"sun\"/></joint>",
    );
    for urdf in [massive, crowded] {
        let found = complaint(&folder(&urdf, FILE, 1, ""));
        assert!(
            found.starts_with("arm.urdf:5: joint 'free' type: \"floating\"; expected "),
            "{found}"
        );
    }
}

#[test]
fn joints_that_move_nothing() {
    let idle = |file: &str, line: usize, joint: &str, body: &str| {
        format!(
            "{file}:{line}: joint '{joint}' can move without moving any mass: too little mass or \
             inertia in body '{body}' and what it carries; expected bodies with mass, a fixed \
             joint, this one in robot.lock, or robot.minimum_mass"
        )
    };
    let sensor = edited(
        ARM,
        "<joint name=\"tip\" type=\"fixed\">",
        "<joint name=\"tip\" type=\"continuous\">",
    );
    assert_eq!(
        complaint(&folder(&sensor, FILE, 3, "")),
        idle("arm.urdf", 52, "tip", "tool0")
    );
    // Locked, it is fine.
    let robot = "{ file = \"arm.urdf\", lock = { tip = 0.0 } }";
    assert_eq!(
        load(&folder(&sensor, robot, 2, ""))
            .problem
            .robot
            .joint_count(),
        2
    );
    // Two massless links in a row about the same axis.
    let twice = edited(WRIST, "<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 0 1\"/>");
    assert_eq!(
        complaint(&folder(&twice, FILE, 3, SPACECRAFT)),
        idle("arm.urdf", 10, "pitch", "pitch_link")
    );
    // A point mass on its own axis.
    let point = edited(EXPORTED, "<origin xyz=\"0 0 0.1\"/>", "");
    assert_eq!(
        complaint(&folder(&point, FILE, 3, "")),
        idle("arm.urdf", 54, "endless", "hand")
    );
}
