//! Descriptions of the base attitude.

use crate::program::{Folder, PROBLEM};
use serde_json::Value;

/// `PROBLEM` with a forearm off the plane, so that the robot moves in space.
pub fn folder_in_space(base: &str) -> Folder {
    let folder = Folder::new(&PROBLEM.replace("[task]", &format!("{base}\n[task]")));
    let robot = folder.read("robot.toml");
    let off = robot.replace("com = [0.35, 0.0, 0.0]", "com = [0.35, 0.0, 0.02]");
    assert_ne!(robot, off);
    folder.write("robot.toml", &off);
    folder
}

#[test]
fn the_attitude_of_a_planar_robot_is_one_angle_whatever_is_asked_for() {
    let text = PROBLEM.replace("[task]", "[base]\nattitude = \"quaternion\"\n\n[task]");
    let run = Folder::new(&text).run(&["check", "case.toml"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    let note = "note: case.toml:6: base.attitude: left aside, the robot is planar and its attitude one angle\n";
    assert!(run.stdout.contains(note), "{}", run.stdout);
    assert!(run.stdout.contains("5: 1 base attitude"), "{}", run.stdout);
}

#[test]
fn check_and_plan_tell_the_rotation_angle() {
    let folder = folder_in_space("[base]\nattitude = \"quaternion\"\n");
    let text = folder.read("case.toml");
    folder.write(
        "case.toml",
        &text.replace(
            "[limits]",
            "[limits]\nbase_attitude = 1.0\nbase_rate = [[-0.6, 0.7], 0.8, 0.9]",
        ),
    );
    let run = folder.run(&["check", "case.toml"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    for expected in [
        "spatial; the base attitude is a unit quaternion",
        "8: 4 base attitude, 2 joint positions, 2 joint rates",
        "base attitude     turned by at most 57.2958°",
        "x -34.3775°/s to 40.107°/s, y ±45.8366°/s, z ±51.5662°/s",
        "1 φ(t_f)² + 0.2 ∫‖θ̇‖²",
        "straight-line base motion: 35.077° about (0.017, 0.010, -1.000), (1.352157, 0.395155, 0.030147) cm",
    ] {
        assert!(
            run.stdout.contains(expected),
            "{expected} in\n{}",
            run.stdout
        );
    }
    let run = folder.run(&["plan", "case.toml", "--out", "out"]);
    assert_eq!(run.code, 0, "{run:?}");
    assert!(run.stdout.contains("° about ("), "{}", run.stdout);
    let solution: Value = serde_json::from_str(&folder.read("out/solution.json")).unwrap();
    let trajectory = &solution["trajectory"];
    assert_eq!(trajectory["attitude"], "quaternion");
    assert_eq!(
        trajectory["base_attitude"][0],
        serde_json::json!([1.0, 0.0, 0.0, 0.0])
    );
    let last = trajectory["base_attitude"]
        .as_array()
        .unwrap()
        .last()
        .unwrap();
    let turned = solution["metrics"]["final_base_attitude"].as_f64().unwrap();
    assert!((2.0 * last[0].as_f64().unwrap().acos() - turned).abs() < 1e-6);
    let csv = folder.read("out/trajectory.csv");
    assert!(
        csv.starts_with("t,eta_1,eta_2,eta_3,eta_4,zeta_1,"),
        "{csv}"
    );
    let run = folder.run(&["verify", "out/solution.json"]);
    assert_eq!(run.code, 0, "{run:?}");
}

#[test]
fn a_warm_start_changes_the_description_of_the_attitude() {
    let folder = folder_in_space("");
    let read = |name: &str| -> Value { serde_json::from_str(&folder.read(name)).unwrap() };
    let mut from = "roll-pitch-yaw";
    let run = folder.run(&["plan", "case.toml", "--out", from]);
    assert_eq!(run.code, 0, "{run:?}");
    for to in ["quaternion", "mrp", "roll-pitch-yaw"] {
        let (set, start) = (
            format!("base.attitude={to}"),
            format!("{from}/solution.json"),
        );
        let out = format!("to-{to}");
        let arguments = [
            "plan",
            "case.toml",
            "--set",
            &set,
            "--warm-start",
            &start,
            "--out",
            &out,
        ];
        let run = folder.run(&arguments);
        assert_eq!(run.code, 0, "{run:?}");
        let (before, after) = (read(&start), read(&format!("{out}/solution.json")));
        assert_eq!(after["trajectory"]["attitude"], to);
        assert_eq!(after["points"], before["points"], "no refinement needed");
        let iterations = |solution: &Value| solution["iterations"][0]["nlp_iterations"].as_u64();
        let allowed = iterations(&before).map(|count| count + 2);
        assert!(iterations(&after) <= allowed, "{run:?}");
        from = out.leak();
    }
    // A description that the rows do not fit.
    let text = folder.read("roll-pitch-yaw/solution.json");
    let damaged = text.replace(
        "\"roll-pitch-yaw\",\n    \"base_attitude",
        "\"quaternion\",\n    \"base_attitude",
    );
    assert_ne!(text, damaged);
    folder.write("damaged.json", &damaged);
    let run = folder.run(&["plan", "case.toml", "--warm-start", "damaged.json"]);
    assert_eq!(run.code, 2, "{run:?}");
    assert_eq!(
        run.stderr,
        "damaged.json: trajectory.base_attitude: 3 values a row do not make an attitude, 4 do; expected a solution.json of schema 1\n"
    );
}
