//! Values from the command line and the problem file.

use crate::program::{Folder, PROBLEM};
use serde_json::Value;

#[test]
fn values_of_the_command_line_go_first() {
    let folder = Folder::new(PROBLEM);
    let arguments = [
        "plan",
        "case.toml",
        "--out",
        "o",
        "--json",
        "--quiet",
        "--method",
        "rpm",
        "--tolerance",
        "2e-2",
        "--set",
        "name=other",
        "--set",
        "task.final.joints={shoulder=0.25,elbow=0.5}",
    ];
    let run = folder.run(&arguments);
    assert_eq!(run.code, 0, "{run:?}");
    let document: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(document["name"], "other");
    assert_eq!(document["method"], "rpm");
    assert_eq!(document["segments"], 1);
    assert_eq!(document["tolerance"], 2e-2);
    let positions = document["trajectory"]["joint_position"].as_array().unwrap();
    let last = positions.last().unwrap();
    assert!((last[0].as_f64().unwrap() - 0.25).abs() < 1e-7);
    assert_eq!(
        document["provenance"]["problem"]["overrides"],
        serde_json::json!([
            "--set name=other",
            "--set task.final.joints={shoulder=0.25,elbow=0.5}",
            "--method rpm",
            "--tolerance 0.02"
        ])
    );
}

#[test]
fn limits_are_understood_in_every_form() {
    let folder = Folder::new(PROBLEM);
    for (form, expected) in [
        ("2.0", "±2 rad/s²"),
        ("[5, 4]", "shoulder ±5 rad/s², elbow ±4 rad/s²"),
        ("[4, 5]", "shoulder ±4 rad/s², elbow ±5 rad/s²"),
        ("[-1, 2]", "-1 rad/s² to 2 rad/s²"),
        ("[0, 2]", "0 rad/s² to 2 rad/s²"),
        (
            "[[-1, 2], 3]",
            "shoulder -1 rad/s² to 2 rad/s², elbow ±3 rad/s²",
        ),
        (
            "{ elbow = [-1, inf] }",
            "shoulder none, elbow from -1 rad/s²",
        ),
        ("inf", "none"),
    ] {
        folder.write("case.toml", &PROBLEM.replace("[5.0, 4.0]", form));
        let run = folder.run(&["check", "case.toml"]);
        assert_eq!(run.code, 0, "{run:?}");
        let line = run
            .stdout
            .lines()
            .find(|line| line.contains(" control "))
            .unwrap();
        let value = line.trim_start().trim_start_matches("control").trim();
        assert_eq!(value, expected, "{form}");
    }
}

#[test]
fn a_locked_joint_is_left_out() {
    let robot = "{ file = \"robot.toml\", lock = { elbow = 0.3 }, end_effector = \"forearm\" }";
    let problem = PROBLEM
        .replace("\"robot.toml\"", robot)
        .replace("[0.0, 0.0]", "[0.0]")
        .replace("[0.5, 1.0]", "{ shoulder = 0.5 }")
        .replace("[5.0, 4.0]", "5.0");
    let run = Folder::new(&problem).run(&["check", "case.toml"]);
    assert_eq!(run.code, 0, "{run:?}");
    assert!(
        run.stdout.contains("2: base 15.2 kg, upper_arm 2.9 kg"),
        "{}",
        run.stdout
    );
    assert!(run.stdout.contains("18.1 kg"));
}
