//! Saved plans that are read are judged: what does not fit is refused, what is not so is said.

use crate::program::{Folder, PROBLEM};
use serde_json::{Value, json};

/// A folder with the plan of `PROBLEM` in `a/`.
fn planned() -> (Folder, Value) {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["plan", "case.toml", "--out", "a", "--quiet"]);
    assert_eq!(run.code, 0, "{run:?}");
    let saved = serde_json::from_str(&folder.read("a/solution.json")).unwrap();
    (folder, saved)
}

fn rows<'a>(saved: &'a mut Value, key: &str) -> &'a mut Vec<Value> {
    saved["trajectory"][key].as_array_mut().unwrap()
}

/// The motion with a base that turns by 120° more than the joints make it turn.
#[test]
fn a_plan_that_re_integration_contradicts_is_not_called_solved() {
    let (folder, mut saved) = planned();
    let times = rows(&mut saved, "t").clone();
    for (row, t) in rows(&mut saved, "base_attitude").iter_mut().zip(times) {
        let turned = row[0].as_f64().unwrap() + t.as_f64().unwrap() / 20.0 * 120_f64.to_radians();
        row[0] = json!(turned);
    }
    folder.write("a/solution.json", &saved.to_string());
    let run = folder.run(&["verify", "a/solution.json", "--out", "v"]);
    assert_eq!((run.code, run.stderr.as_str()), (4, ""), "{run:?}");
    assert!(
        run.stdout
            .starts_with("case: NOT confirmed, though it was saved as solved: "),
        "{}",
        run.stdout
    );
    assert!(
        run.stdout.contains("the base drifts by 120."),
        "{}",
        run.stdout
    );
    assert!(!run.stdout.contains("planned (solved)"), "{}", run.stdout);
    let found: Value = serde_json::from_str(&folder.read("v/verification.json")).unwrap();
    assert_eq!(found["confirmed"], false);
    assert!(found["doubt"].as_str().unwrap().contains("the base drifts"));

    let run = folder.run(&["report", "a/solution.json"]);
    assert_eq!((run.code, run.stderr.as_str()), (4, ""), "{run:?}");
    assert!(run.stdout.contains("NOT confirmed"), "{}", run.stdout);
    let page = folder.read("a/report.html");
    assert!(page.contains("<title>case · not converged</title>"));
    assert!(page.contains("is not the one that they give it"));
    assert!(!page.contains("can be trusted"));
}

/// What is not what the task asks for is no solution of it, however well it integrates.
#[test]
fn a_plan_for_another_task_is_not_called_solved() {
    for (change, said) in [
        ("task.duration=25", "takes 20 s, and the task gives it 25 s"),
        (
            "task.final.joints=[0.6, 1.0]",
            "the position of joint shoulder is 28.65°, and the task has it at 34.38°",
        ),
        ("limits.control=[5.0, 1e-3]", "limits.control = ±"),
    ] {
        let (folder, mut saved) = planned();
        saved["provenance"]["problem"]["overrides"] = json!([format!("--set {change}")]);
        folder.write("a/solution.json", &saved.to_string());
        for command in ["verify", "report"] {
            let run = folder.run(&[command, "a/solution.json"]);
            assert_eq!((run.code, run.stderr.as_str()), (4, ""), "{run:?}");
            assert!(run.stdout.contains("NOT confirmed"), "{}", run.stdout);
            assert!(run.stdout.contains(said), "{said} in\n{}", run.stdout);
        }
    }
}

#[test]
fn what_does_not_follow_from_the_motion_is_doubted() {
    for (key, said) in [
        ("base_position", "the base position was saved as "),
        ("base_rate", "the base rate was saved as "),
        ("joint_torque", "the joint torque was saved as "),
    ] {
        let (folder, mut saved) = planned();
        let value = &mut rows(&mut saved, key)[7][0];
        *value = json!(value.as_f64().unwrap() + 0.1);
        folder.write("a/solution.json", &saved.to_string());
        let run = folder.run(&["verify", "a/solution.json"]);
        assert_eq!((run.code, run.stderr.as_str()), (4, ""), "{run:?}");
        assert!(run.stdout.contains(said), "{said} in\n{}", run.stdout);
    }
}

/// Figures and checks of a page are those of the motion, whatever the file says of them.
#[test]
fn a_page_says_nothing_that_was_not_checked_now() {
    let (folder, mut saved) = planned();
    let page = folder.read("a/report.html");
    saved["verification"]["max_joint_drift"] = json!(0.777);
    saved["metrics"]["max_base_attitude"] = json!(0.123);
    saved["metrics"]["final_base_displacement"] = json!(0.456);
    saved["objective"] = json!(42.0);
    // Off by less than what is doubted.
    let torque = &mut rows(&mut saved, "joint_torque")[5][0];
    *torque = json!(torque.as_f64().unwrap() + 1e-12);
    saved["cost_terms"][0]["value"] = json!(41.0);
    folder.write("a/solution.json", &saved.to_string());
    let run = folder.run(&["report", "a/solution.json"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    assert!(folder.read("a/report.html") == page, "another page");
    assert!(page.contains("when it was planned"));
}

type Damage = fn(&mut Value);

/// What is done to a saved plan, and how the complaint begins.
const DAMAGES: [(&str, Damage); 14] = [
    ("trajectory.t[3]: ", |saved| {
        saved["trajectory"]["t"][3] = saved["trajectory"]["t"][2].clone();
    }),
    ("trajectory.t[0]: 0.1; expected 0", |saved| {
        saved["trajectory"]["t"][0] = json!(0.1);
    }),
    ("trajectory.t[4]: ", |saved| {
        let t = &mut saved["trajectory"]["t"][4];
        *t = json!(t.as_f64().unwrap() + 1e-4);
    }),
    (
        "trajectory.t: 30 times; expected 31, one a node of the mesh",
        |saved| {
            rows(saved, "t").pop();
        },
    ),
    ("trajectory.base_position: 30 rows; expected 31", |saved| {
        rows(saved, "base_position").pop();
    }),
    (
        "trajectory.joint_torque: row 7 has 1 values; expected 2",
        |saved| {
            rows(saved, "joint_torque")[7].as_array_mut().unwrap().pop();
        },
    ),
    (
        "trajectory.control: 3 values a row; expected 2, for robot 'planar-2link'",
        |saved| {
            for row in rows(saved, "control") {
                row.as_array_mut().unwrap().push(json!(0.0));
            }
        },
    ),
    (
        "trajectory.base_rate: 3 values a row; expected 1",
        |saved| {
            for row in rows(saved, "base_rate") {
                *row = json!([0.0, 0.0, 0.0]);
            }
        },
    ),
    ("points: 21; expected 30, as its mesh has", |saved| {
        saved["points"] = json!(21);
    }),
    ("segments: 3; expected 6, as its mesh has", |saved| {
        saved["segments"] = json!(3);
    }),
    ("mesh: ", |saved| {
        saved["mesh"]["breakpoints"]
            .as_array_mut()
            .unwrap()
            .remove(1);
    }),
    ("iterate.lower_multipliers: ", |saved| {
        let values = &mut saved["iterate"]["lower_multipliers"];
        values.as_array_mut().unwrap().pop();
    }),
    ("provenance.robot: ", |saved| {
        let text = &mut saved["provenance"]["robot"]["text"];
        *text = json!(text.as_str().unwrap().replace("mass = 1.70", "mass = 1.71"));
    }),
    (
        "trajectory.attitude: \"roll-pitch-yaw\"; expected \"angle\"",
        |saved| {
            saved["trajectory"]["attitude"] = json!("roll-pitch-yaw");
            for row in rows(saved, "base_attitude") {
                *row = json!([0.0, 0.0, row[0]]);
            }
        },
    ),
];

#[test]
fn what_does_not_fit_in_a_saved_plan_is_refused() {
    let (folder, saved) = planned();
    for (said, damage) in DAMAGES {
        let mut damaged = saved.clone();
        damage(&mut damaged);
        folder.write("damaged.json", &damaged.to_string());
        for arguments in [
            &["verify", "damaged.json"][..],
            &["report", "damaged.json"],
            &["plan", "case.toml", "--warm-start", "damaged.json"],
        ] {
            let run = folder.run(arguments);
            assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{said}: {run:?}");
            assert_eq!(run.stderr.lines().count(), 1, "{run:?}");
            let expected = format!("damaged.json: {said}");
            assert!(run.stderr.starts_with(&expected), "{expected}\n{run:?}");
        }
    }
    assert_eq!(
        folder.names(),
        ["a", "case.toml", "damaged.json", "robot.toml"]
    );
}

#[test]
fn a_start_from_another_robot_of_as_many_joints_is_taken_with_a_note() {
    let (folder, _) = planned();
    let robot = folder.read("robot.toml");
    folder.write("robot.toml", &robot.replace("mass = 1.70", "mass = 1.75"));
    let start = [
        "plan",
        "case.toml",
        "--warm-start",
        "a/solution.json",
        "--out",
        "b",
    ];
    let run = folder.run(&start);
    assert_eq!(run.code, 0, "{run:?}");
    assert_eq!(run.stderr.lines().count(), 1, "{run:?}");
    let note = "note: a/solution.json: planned for another robot, robot.toml (SHA-256 ";
    assert!(run.stderr.starts_with(note), "{run:?}");
    // Its own robot is none to speak of.
    folder.write("robot.toml", &robot);
    assert_eq!(folder.run(&start).stderr, "");
}
