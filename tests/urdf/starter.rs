//! `init --urdf`: what is listed and chosen, and that the problem plans.

use crate::program::{Folder, PROBLEM, edited};
use crate::robots::*;

fn solid(mass: f64) -> String {
    let moment = 0.01 * mass;
    format!(
        "<inertial><origin xyz=\"0.1 0 0\"/><mass value=\"{mass}\"/><inertia ixx=\"{moment}\" \
         ixy=\"0\" ixz=\"0\" iyy=\"{moment}\" iyz=\"0\" izz=\"{moment}\"/></inertial>"
    )
}

fn joint(name: &str, kind: &str, parent: &str, child: &str, rest: &str) -> String {
    format!(
        "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
         <origin xyz=\"0.2 0 0.05\"/>{rest}</joint>\n"
    )
}

/// An arm of three joints with a camera and a gripper of two fingers, one of which follows.
fn gripper() -> String {
    let mut text = String::from("<robot name=\"my arm/2\">\n<link name=\"world\"/>\n");
    for (name, mass) in [
        ("plate", 1.0),
        ("upper", 3.0),
        ("lower", 2.0),
        ("palm", 1.0),
        ("left", 0.1),
        ("right", 0.1),
    ] {
        text += &format!("<link name=\"{name}\">{}</link>\n", solid(mass));
    }
    text += "<link name=\"camera\"/><link name=\"hand_tcp\"/>\n";
    let limit = "<limit lower=\"-2\" upper=\"2\" velocity=\"1\" effort=\"20\"/>";
    let slide = "<axis xyz=\"0 1 0\"/><limit lower=\"0.01\" upper=\"0.05\" velocity=\"0.1\" effort=\"10\"/>";
    text += &joint("mount", "fixed", "world", "plate", "");
    text += &joint(
        "pan",
        "continuous",
        "plate",
        "upper",
        "<axis xyz=\"0 0 1\"/>",
    );
    text += &joint(
        "lift",
        "revolute",
        "upper",
        "lower",
        &format!("<axis xyz=\"0 1 0\"/>{limit}"),
    );
    text += &joint(
        "roll",
        "revolute",
        "lower",
        "palm",
        &format!("<axis xyz=\"1 0 0\"/>{limit}"),
    );
    text += &joint("eye", "fixed", "palm", "camera", "");
    text += &joint("tcp", "fixed", "palm", "hand_tcp", "");
    text += &joint("finger l", "prismatic", "palm", "left", slide);
    text += &joint(
        "finger r",
        "prismatic",
        "palm",
        "right",
        &format!("{slide}<mimic joint=\"finger l\"/>"),
    );
    text + "</robot>\n"
}

fn init(urdf: &str) -> (Folder, String, String) {
    let folder = Folder::new(PROBLEM);
    folder.write("arm.urdf", urdf);
    let run = folder.run(&["init", "mine", "--urdf", "arm.urdf"]);
    assert_eq!(run.code, 0, "{run:?}");
    (folder, run.stdout, run.stderr)
}

#[test]
fn an_arm_with_a_gripper() {
    let (folder, listed, said) = init(&gripper());
    assert_eq!(said, "");
    for line in [
        "  robot               my arm/2, from arm.urdf\n",
        "  joints              5\n",
        "    pan               moves upper: no position limit\n",
        "    lift              moves lower: ±114.592°, 57.2958°/s, 20 N·m\n",
        "    finger l          moves left: 1 cm to 5 cm, 10 cm/s, 10 N; held at 3 cm\n",
        "    finger r          moves right: 1 cm to 5 cm, 10 cm/s, 10 N; held at 3 cm\n",
        "  base                world, on a spacecraft of 25 kg: give your own in [base]\n",
        "  end effector        hand_tcp\n",
    ] {
        assert!(listed.contains(line), "{line}\n{listed}");
    }
    assert_eq!(folder.read("mine/arm.urdf"), gripper());
    let check = folder.run(&["check", "mine/problem.toml"]);
    assert_eq!(check.code, 0, "{check:?}");
    assert!(
        check
            .stdout
            .contains("degrees of freedom  9: 3 of the joints"),
        "{}",
        check.stdout
    );
    let plan = folder.run(&["plan", "mine/problem.toml", "--out", "o"]);
    assert_eq!(plan.code, 0, "{plan:?}");
    assert!(plan.stdout.starts_with("my-arm-2: "), "{}", plan.stdout);
}

#[test]
fn files_that_are_there_stay() {
    let (folder, ..) = init(ARM);
    let before = folder.read("mine/problem.toml");
    let again = folder.run(&["init", "mine", "--urdf", "arm.urdf"]);
    assert_eq!(again.code, 2, "{again:?}");
    assert!(
        again
            .stderr
            .starts_with("mine/problem.toml: is there already"),
        "{again:?}"
    );
    // The robot's file alone is reason enough.
    std::fs::remove_file(folder.path().join("mine/problem.toml")).unwrap();
    folder.write("mine/arm.urdf", "another");
    let again = folder.run(&["init", "mine", "--urdf", "arm.urdf"]);
    assert_eq!(again.code, 2, "{again:?}");
    assert_eq!(folder.read("mine/arm.urdf"), "another");
    assert!(!folder.path().join("mine/problem.toml").exists());
    // In its own folder the file is named as it is, and not copied.
    folder.write("mine/arm.urdf", ARM);
    let beside = folder.run(&["init", "mine", "--urdf", "mine/arm.urdf"]);
    assert_eq!(beside.code, 0, "{beside:?}");
    assert_eq!(folder.read("mine/problem.toml"), before);
    assert_eq!(folder.read("mine/arm.urdf"), ARM);
}

#[test]
fn what_the_file_lacks_is_made_up_for_and_said() {
    // Without masses, and with one inertia that no body has.
    let bare = without_masses(&gripper());
    let (folder, _, said) = init(&bare);
    assert_eq!(
        said.matches("as robot.minimum_mass asks").count(),
        3,
        "{said}"
    );
    assert_eq!(folder.run(&["check", "mine/problem.toml"]).code, 0);
    let odd = edited(
        ARM,
        "<inertia ixx=\"0.02\" ixy=\"0.001\" ixz=\"0\" iyy=\"0.09\" iyz=\"0\" izz=\"0.1\"/>",
        "<inertia ixx=\"0.02\" ixy=\"0\" ixz=\"0\" iyy=\"0.09\" iyz=\"0\" izz=\"0.112\"/>",
    );
    let (folder, _, said) = init(&odd);
    assert!(
        said.starts_with("warning: arm.urdf:21: link 'upper'"),
        "{said}"
    );
    assert!(
        folder
            .read("mine/problem.toml")
            .contains("repair = \"inertia\"")
    );
}

/// The text without any `<inertial>`.
fn without_masses(text: &str) -> String {
    let mut rest = text;
    let mut bare = String::new();
    while let Some((before, after)) = rest.split_once("<inertial>") {
        bare += before;
        rest = after.split_once("</inertial>").expect("an end").1;
    }
    bare + rest
}

#[test]
fn every_robot_of_these_tests_gets_a_problem() {
    for urdf in [
        ARM,
        TWO_ARMS,
        EXPORTED,
        FLOATING,
        WRIST,
        GRIPPER,
        crate::robots::ROUNDED,
    ] {
        let (folder, ..) = init(urdf);
        let check = folder.run(&["check", "mine/problem.toml"]);
        assert_eq!(check.code, 0, "{check:?}");
    }
}

#[test]
fn what_cannot_be_read_is_refused_and_nothing_written() {
    let folder = Folder::new(PROBLEM);
    for (name, text, expected) in [
        (
            "arm.urdf",
            "<robot><link name=\"a\"/>",
            "arm.urdf:1: not XML",
        ),
        ("arm.xacro", "", "arm.xacro: expected URDF: run xacro"),
        (
            "arm.urdf",
            &ARM.replace("value=\"4\"", "value=\"-4\""),
            "arm.urdf:20: link 'upper'",
        ),
    ] {
        folder.write(name, text);
        let run = folder.run(&["init", "mine", "--urdf", name]);
        assert_eq!(run.code, 2, "{run:?}");
        assert!(run.stderr.starts_with(expected), "{run:?}");
        assert!(!folder.path().join("mine").exists());
    }
    let run = folder.run(&["init", "mine", "--urdf", "none.urdf"]);
    assert!(
        run.code == 2 && run.stderr.starts_with("none.urdf: cannot be read"),
        "{run:?}"
    );
}
