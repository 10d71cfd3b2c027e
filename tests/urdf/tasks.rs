//! Tasks about robots in URDF: a base that starts turned, rates, the long way round.

use crate::program::{Folder, edited};
use crate::robots::*;

fn with(initial: &str) -> Folder {
    let folder = folder(ARM, FILE, 2, "");
    let start = "initial.joints = [0.1, 0.1]\n";
    folder.write(
        "case.toml",
        &edited(
            &folder.read("case.toml"),
            start,
            &format!("{start}{initial}"),
        ),
    );
    folder
}

#[test]
fn one_rate_for_all_joints() {
    let rates = |initial: &str| load(&with(initial)).problem.task.initial_rates.clone();
    assert_eq!(rates("initial.rates = 0\n"), [0.0, 0.0]);
    assert_eq!(rates("initial.rates = 0.05\n"), [0.05, 0.05]);
    assert_eq!(rates("initial.rates = [0.05, 0.0]\n"), [0.05, 0.0]);
    assert!(complaint(&with("initial.rates = nan\n")).contains("task.initial.rates"));
}

#[test]
fn a_base_that_starts_turned() {
    let folder = with("initial.base_attitude = { roll = 0.0, pitch = 0.1, yaw = -0.2 }\n");
    assert_eq!(
        load(&folder).problem.task.initial_base_attitude,
        [0.0, 0.1, -0.2]
    );
    let check = folder.run(&["check", "case.toml"]).stdout;
    let line = "base at the start   turned 0°, 5.72958°, -11.4592°\n";
    assert!(check.contains(line), "{check}");
    // Of the attitude it is planned with nothing is lost on the way through the files.
    let run = folder.run(&[
        "plan",
        "case.toml",
        "--method",
        "straight-line",
        "--out",
        ".",
    ]);
    assert!(folder.names().contains(&"solution.json".into()), "{run:?}");
    let verify = folder.run(&["verify", "solution.json", "--out", "."]);
    assert_eq!(verify.code, 0, "{verify:?}");
    let found: serde_json::Value = serde_json::from_str(&folder.read("solution.json")).unwrap();
    let start = &found["trajectory"]["base_attitude"][0];
    assert_eq!(*start, serde_json::json!([0.0, 0.1, -0.2]));
    assert!(
        found["verification"]["replay_base_attitude_drift"]
            .as_f64()
            .unwrap()
            < 1e-6
    );
    let steep = complaint(&with(
        "initial.base_attitude = [0.0, 1.5707963267948966, 0.0]\n",
    ));
    assert!(
        steep.contains("task.initial.base_attitude[1]")
            && steep.contains("base.attitude = \"quaternion\""),
        "{steep}"
    );
    let three = complaint(&with("initial.base_attitude = 0.1\n"));
    assert!(
        three.contains("3, one a base angle: roll, pitch, yaw"),
        "{three}"
    );
}

#[test]
fn the_long_way_round_is_pointed_out() {
    let endless = edited(
        ARM,
        "<joint name=\"shoulder\" type=\"revolute\">",
        "<joint name=\"shoulder\" type=\"continuous\">",
    );
    let notes = |goal: &str| {
        let folder = folder(&endless, FILE, 2, "");
        let text = edited(&folder.read("case.toml"), "[0.3, 0.3]", goal);
        folder.write("case.toml", &text);
        load(&folder).notes
    };
    assert!(notes("[3.2, 0.3]").is_empty());
    let [note] = &notes("[6.0, 0.3]")[..] else {
        panic!("one note");
    };
    assert!(
        note.starts_with("case.toml:8: task.final.joints: joint 'shoulder', which has no limits, goes 338.0° the long way round; -0.283185 is the same orientation after -22.0°")
            || note.contains("case.toml:8: task.final.joints: joint 'shoulder'"),
        "{note}"
    );
    assert!(
        note.ends_with("-0.283185 is the same orientation after -22.0°"),
        "{note}"
    );
    // A joint with limits has no other way.
    let folder = folder(
        ARM,
        FILE,
        2,
        "\n[limits]\njoint_position = [[-7.0, 7.0], [-1.0, 1.0]]\n",
    );
    folder.write(
        "case.toml",
        &edited(&folder.read("case.toml"), "[0.3, 0.3]", "[6.0, 0.3]"),
    );
    assert!(load(&folder).notes.is_empty());
}
