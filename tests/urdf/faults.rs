//! All that is wrong with a file is said at once.

use crate::program::edited;
use crate::robots::*;

/// A chain of `n` links on a base, each as `link` has it for its number.
fn chain(n: usize, link: impl Fn(usize) -> String) -> String {
    let mut text = String::from("<robot name=\"chain\">\n");
    for k in 0..=n {
        text += &format!("<link name=\"l{k}\">{}</link>\n", link(k));
    }
    for k in 1..=n {
        text += &format!(
            "<joint name=\"j{k}\" type=\"revolute\"><parent link=\"l{}\"/><child link=\"l{k}\"/>\
             <origin xyz=\"0.2 0 0\"/><axis xyz=\"0 {} {}\"/>\
             <limit lower=\"-2\" upper=\"2\" velocity=\"1\" effort=\"10\"/></joint>\n",
            k - 1,
            k % 2,
            1 - k % 2,
        );
    }
    text + "</robot>\n"
}

const SOLID: &str = "<inertial><mass value=\"1\"/><inertia ixx=\"0.01\" ixy=\"0\" ixz=\"0\" \
                     iyy=\"0.01\" iyz=\"0\" izz=\"0.01\"/></inertial>";
const THIN: &str = "<inertial><mass value=\"1\"/><inertia ixx=\"0.0100\" ixy=\"0\" ixz=\"0\" \
                    iyy=\"0.0100\" iyz=\"0\" izz=\"0.0900\"/></inertial>";

#[test]
fn faults_of_many_kinds_in_one_message() {
    let text = edited(ARM, "<mass value=\"4\"/>", "<mass value=\"-4\"/>");
    let text = edited(&text, "<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 0\"/>");
    let text = edited(&text, "izz=\"2.2\"", "izz=\"none\"");
    let message = refusal(&text);
    assert!(
        message.starts_with("arm.urdf: 3 faults: (1) arm.urdf:"),
        "{message}"
    );
    for part in [
        "izz: \"none\"; expected a finite number, kg m²; (2) arm.urdf:14: joint 'shoulder' <axis>",
        "xyz: \"0 0 0\"; expected 3 finite numbers that are not all zero; (3) arm.urdf:20: link",
        "'upper' <inertial> <mass> value: \"-4\"; expected a finite mass of zero or above, kg",
    ] {
        assert!(message.contains(part), "{part}\n{message}");
    }
}

#[test]
fn the_list_is_bounded() {
    let message = refusal(&chain(20, |_| THIN.into()));
    assert!(
        message.starts_with("arm.urdf: 21 faults: (1) arm.urdf:2: link 'l0'"),
        "{message}"
    );
    assert!(message.ends_with("; and 13 more"), "{message}");
    assert!(
        message.contains("(8) ") && !message.contains("(9) "),
        "{message}"
    );
    assert!(message.len() < 4000, "{}", message.len());
}

#[test]
fn faults_of_the_tree_at_once() {
    let text = chain(3, |_| SOLID.into());
    let text = text.replace("<child link=\"l2\"/>", "<child link=\"elbow\"/>");
    let text = text.replace("<parent link=\"l2\"/>", "<parent link=\"forearm\"/>");
    let message = refusal(&text);
    assert!(message.starts_with("arm.urdf: 2 faults: "), "{message}");
    for name in [
        "\"elbow\"; expected the name of a link",
        "\"forearm\"; expected the name of a link",
    ] {
        assert!(message.contains(name), "{message}");
    }
}

#[test]
fn a_kinematic_model_is_called_one_once() {
    let message = refusal(&chain(6, |_| String::new()));
    assert!(
        message.starts_with("arm.urdf:1: no link has <inertial>: a kinematic model"),
        "{message}"
    );
    assert_eq!(message.matches("joint").count(), 1, "{message}");
    // The spacecraft alone does not make it another.
    assert_eq!(
        complaint(&folder(&chain(6, |_| String::new()), FILE, 6, SPACECRAFT)),
        message
    );
}

#[test]
fn massless_joints_are_named_together() {
    let some = |k| if k < 3 { SOLID.into() } else { String::new() };
    let message = refusal(&chain(5, some));
    assert_eq!(
        message.matches("can move without moving any mass").count(),
        1,
        "{message}"
    );
    assert!(message.contains("joint 'j3'"), "{message}");
    assert!(message.ends_with("; likewise 'j4', 'j5'"), "{message}");
}

#[test]
fn names_that_xacro_would_replace() {
    let message = refusal(&chain(1, |_| SOLID.into()).replace("\"l1\"", "\"${prefix}l1\""));
    assert!(
        message.contains("(an expression of xacro's; run xacro on the file first)"),
        "{message}"
    );
}
