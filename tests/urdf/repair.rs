//! `robot.repair` and `robot.minimum_mass`: what is changed, what is not, and that it is said.

use crate::program::{Folder, edited};
use crate::robots::*;
use ffsm_ipopt::config::ProblemFile;
use ffsm_ipopt::dynamics::Inertia;
use serde_json::Value;

const UPPER: &str =
    "<inertia ixx=\"0.02\" ixy=\"0.001\" ixz=\"0\" iyy=\"0.09\" iyz=\"0\" izz=\"0.1\"/>";
/// The largest moment exceeds the sum of the others by 1.8 %.
const ROUNDED: &str =
    "<inertia ixx=\"0.02\" ixy=\"0\" ixz=\"0\" iyy=\"0.09\" iyz=\"0\" izz=\"0.112\"/>";
const WRONG: &str =
    "<inertia ixx=\"0.0200\" ixy=\"0\" ixz=\"0\" iyy=\"0.0200\" iyz=\"0\" izz=\"0.1000\"/>";
const REPAIRED: &str = "{ file = \"arm.urdf\", repair = \"inertia\" }";

fn moments(file: &ProblemFile, joint: usize) -> [f64; 3] {
    file.problem.robot.joints()[joint].body.inertia.moments()
}

#[test]
fn rounding_is_mended_and_said() {
    let text = edited(ARM, UPPER, ROUNDED);
    let refused = complaint(&folder(&text, FILE, 2, ""));
    assert!(
        refused.ends_with(
            "the largest may not exceed the sum of the others; robot.repair = \"inertia\" (or \
             --repair) takes the nearest that a body can have"
        ),
        "{refused}"
    );
    let folder = folder(&text, REPAIRED, 2, "");
    let file = load(&folder);
    let [a, b, c] = moments(&file, 0);
    assert!((c - a - b).abs() < 1e-15 && (c - (0.112 - 0.002 / 3.0)).abs() < 1e-15);
    let [change] = &file.repairs[..] else {
        panic!("{:?}", file.repairs)
    };
    assert!(
        change.contains("arm.urdf:21: link 'upper' <inertial> <inertia>: inertia breaks")
            && change.contains("taken as the nearest that a body can have, 2.0"),
        "{change}"
    );
    let said = &change[change.find("arm.urdf").expect("the file")..];
    let check = folder.run(&["check", "case.toml"]);
    assert!(
        check.stdout.contains(&format!("warning: {said}\n")),
        "{check:?}"
    );
}

#[test]
fn the_option_does_the_same_and_is_kept() {
    let folder = folder(&edited(ARM, UPPER, ROUNDED), FILE, 2, "");
    let check = folder.run(&["check", "case.toml", "--repair"]);
    assert_eq!(check.code, 0, "{check:?}");
    let run = folder.run(&[
        "plan",
        "case.toml",
        "--repair",
        "--method",
        "straight-line",
        "--out",
        ".",
    ]);
    assert!(
        run.stderr.contains("warning: arm.urdf:21: link 'upper'"),
        "{run:?}"
    );
    let saved: Value = serde_json::from_str(&folder.read("solution.json")).unwrap();
    let kept = &saved["provenance"];
    assert_eq!(
        kept["problem"]["overrides"],
        serde_json::json!(["--repair"])
    );
    assert_eq!(kept["repairs"].as_array().map(Vec::len), Some(1), "{kept}");
    for command in ["verify", "report"] {
        let again = folder.run(&[command, "solution.json"]);
        assert_eq!(again.code, 0, "{again:?}");
    }
    assert!(
        folder
            .read("report.html")
            .contains("arm.urdf:21: link &#39;upper&#39;")
            || folder
                .read("report.html")
                .contains("arm.urdf:21: link 'upper'")
    );
}

#[test]
fn what_no_rounding_explains_is_refused_where_it_moves() {
    let text = edited(ARM, UPPER, WRONG);
    let message = complaint(&folder(&text, REPAIRED, 2, ""));
    assert!(
        message.ends_with("the nearest that a body can have is 4.000e-2, 4.000e-2, 8.000e-2"),
        "{message}"
    );
    // Locked, the joint moves it no more.
    let locked = "{ file = \"arm.urdf\", repair = \"inertia\", lock = { shoulder = 0.0 } }";
    let file = load(&folder(&text, locked, 1, ""));
    assert_eq!(file.repairs.len(), 1, "{:?}", file.repairs);
}

#[test]
fn spin_without_mass_is_dropped_from_what_is_fixed() {
    let spin = edited(ARM, "<mass value=\"0.5\"/>", "<mass value=\"0\"/>");
    assert!(complaint(&folder(&spin, FILE, 2, "")).contains("mass is zero but inertia is not"));
    let file = load(&folder(&spin, REPAIRED, 2, ""));
    assert!(
        file.repairs[0].ends_with("taken as neither"),
        "{:?}",
        file.repairs
    );
    assert_eq!(file.problem.robot.joints()[1].body.inertia.mass(), 3.0);
}

#[test]
fn the_root_may_be_anything_under_a_spacecraft() {
    let root = |inertial: &str| {
        format!(
            "<robot name=\"r\"><link name=\"root\">{inertial}</link><link name=\"arm\"><inertial>\
             <mass value=\"2\"/><origin xyz=\"0.2 0 0\"/><inertia ixx=\"0.02\" ixy=\"0\" ixz=\"0\" \
             iyy=\"0.02\" iyz=\"0\" izz=\"0.02\"/></inertial></link><joint name=\"j\" \
             type=\"continuous\"><parent link=\"root\"/><child link=\"arm\"/><axis xyz=\"0 0 1\"/>\
             </joint></robot>"
        )
    };
    let own = |mass: &str, izz: &str| {
        format!(
            "<inertial><mass value=\"{mass}\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" \
             iyz=\"0\" izz=\"{izz}\"/></inertial>"
        )
    };
    for (inertial, changes) in [
        (String::new(), 0),
        (own("1", "1"), 0),
        (own("1", "9"), 1),
        (own("0", "1"), 1),
        (own("-1", "1"), 1),
        (own("1", "nan"), 1),
        ("<inertial><mass value=\"7\"/></inertial>".into(), 1),
    ] {
        let text = root(&inertial);
        let file = load(&folder(&text, FILE, 1, SPACECRAFT));
        assert_eq!(
            file.repairs.len(),
            changes,
            "{inertial}: {:?}",
            file.repairs
        );
        let base = &file.problem.robot.base().inertia;
        let own = if changes == 0 && !inertial.is_empty() {
            1.0
        } else {
            0.0
        };
        assert_eq!(base.mass(), 200.0 + own, "{inertial}");
        if changes == 1 {
            let said = "left aside, [base] stands for this link";
            assert!(file.repairs[0].ends_with(said), "{:?}", file.repairs);
            complaint(&folder(&text, FILE, 1, ""));
        }
    }
    // Without a spacecraft, the nearest that can be, however far.
    let file = load(&folder(&root(&own("1", "9")), REPAIRED, 1, ""));
    let moments = file.problem.robot.base().inertia.moments();
    assert!(
        (moments[2] - (9.0 - 7.0 / 3.0)).abs() < 1e-12,
        "{moments:?}"
    );
}

#[test]
fn massless_links_get_a_mass_where_asked() {
    let robot = "{ file = \"arm.urdf\", minimum_mass = 0.05 }";
    let bare = |folder: &Folder| complaint(folder);
    let text = "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>\
         <joint name=\"p\" type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0 1\"/></joint>\
         <joint name=\"q\" type=\"continuous\"><parent link=\"b\"/><child link=\"c\"/><origin xyz=\"0.3 0 0\"/>\
         <axis xyz=\"0 1 0\"/></joint></robot>";
    assert!(bare(&folder(text, FILE, 2, SPACECRAFT)).contains("a kinematic model"));
    let file = load(&folder(text, robot, 2, SPACECRAFT));
    assert_eq!(file.repairs.len(), 2);
    assert!(file.repairs[0].contains("joint 'p' moves 0 kg in body 'b': made 0.05 kg"));
    assert_eq!(
        file.problem.robot.joints()[1].body.inertia,
        Inertia::ball(0.05)
    );
    // Those of the arm are heavier.
    assert!(load(&folder(ARM, robot, 2, "")).repairs.is_empty());
}

#[test]
fn robots_in_toml_are_repaired_alike() {
    let folder = folder(
        ARM,
        "{ file = \"robot.toml\", repair = \"inertia\" }",
        2,
        "",
    );
    let text = folder.read("robot.toml");
    let line = text
        .lines()
        .find(|line| line.trim_start().starts_with("inertia"))
        .unwrap();
    folder.write(
        "robot.toml",
        &text.replacen(line, "inertia = [1.0, 1.0, 2.01]", 1),
    );
    assert_eq!(load(&folder).repairs.len(), 1);
    folder.write(
        "case.toml",
        &edited(&folder.read("case.toml"), ", repair = \"inertia\"", ""),
    );
    let message = complaint(&folder);
    assert!(
        message.contains("robot.repair = \"inertia\" (or --repair)"),
        "{message}"
    );
}

#[test]
fn other_repairs_are_not_known() {
    let message = complaint(&folder(
        ARM,
        "{ file = \"arm.urdf\", repair = \"all\" }",
        2,
        "",
    ));
    assert_eq!(
        message,
        "case.toml:3: robot.repair: a string (\"all\"); expected \"inertia\", the only repair there is"
    );
    let message = complaint(&folder(
        ARM,
        "{ file = \"arm.urdf\", minimum_mass = 0 }",
        2,
        "",
    ));
    assert!(
        message.starts_with("case.toml:3: robot.minimum_mass: 0; expected"),
        "{message}"
    );
}
