//! One figure for one thing, wherever it is shown, with digits that fit its size.

use crate::attitude::folder_in_space;
use crate::program::{Folder, PROBLEM};
use serde_json::Value;

fn solution(folder: &Folder) -> Value {
    serde_json::from_str(&folder.read("out/solution.json")).unwrap()
}

/// The angle of the rotation that roll, pitch and yaw describe.
fn rotation_angle(row: &Value) -> f64 {
    let [roll, pitch, yaw] = [0, 1, 2].map(|i| 0.5 * row[i].as_f64().unwrap());
    let scalar = roll.cos() * pitch.cos() * yaw.cos() + roll.sin() * pitch.sin() * yaw.sin();
    2.0 * scalar.abs().min(1.0).acos()
}

#[test]
fn the_base_angle_is_one_figure() {
    // Turned about all three axes.
    let folder = folder_in_space("");
    let robot = folder.read("robot.toml");
    let tilted = robot.replace("com = [0.35, 0.0, 0.02]", "com = [0.35, 0.1, 0.3]");
    assert_ne!(robot, tilted);
    folder.write("robot.toml", &tilted);
    let run = folder.run(&["plan", "case.toml", "--out", "out"]);
    assert_eq!(run.code, 0, "{run:?}");
    let saved = solution(&folder);
    assert_eq!(saved["trajectory"]["attitude"], "roll-pitch-yaw");
    let rows = saved["trajectory"]["base_attitude"].as_array().unwrap();
    let angles: Vec<f64> = rows.iter().map(rotation_angle).collect();
    let [most, last] = ["max_base_attitude", "final_base_attitude"]
        .map(|key| saved["metrics"][key].as_f64().unwrap());
    assert!((last - angles[angles.len() - 1]).abs() < 1e-9, "{last}");
    let at_nodes = angles.iter().fold(0.0, |a: f64, b| a.max(*b));
    assert!(
        most >= at_nodes - 1e-9 && most < at_nodes + 0.05,
        "{most}, {at_nodes}"
    );
    // More than any of the three angles.
    let largest = rows.iter().flat_map(|row| row.as_array().unwrap());
    let largest = largest.fold(0.0, |a: f64, b| a.max(b.as_f64().unwrap().abs()));
    assert!(most > largest + 1e-4, "{most}, {largest}");

    let [most, last] = [most, last].map(|angle| format!("{:.3}°", angle.to_degrees()));
    let summary = format!("base attitude       largest {most}, final {last} (");
    assert!(
        run.stdout.contains(&summary),
        "{summary} in\n{}",
        run.stdout
    );
    let page = folder.read("out/report.html");
    for said in [
        format!("turned by at most {most} on its way, and ends turned by {last} and "),
        format!("<td>{most} at most, {last} at the end"),
    ] {
        assert!(page.contains(&said), "{said}");
    }
}

#[test]
fn an_infeasible_plan_has_one_cost() {
    let tight = PROBLEM.replace("joint_velocity = 0.9", "joint_velocity = 0.06");
    let folder = Folder::new(&tight);
    let run = folder.run(&[
        "plan",
        "case.toml",
        "--method",
        "straight-line",
        "--out",
        "out",
    ]);
    assert_eq!(run.code, 3, "{run:?}");
    // By the joint's name.
    let named = "(rate of joint elbow) does not hold along the motion of straight-line";
    assert!(run.stdout.contains(named), "{}", run.stdout);
    let cost = format!("{:.9}", solution(&folder)["objective"].as_f64().unwrap());
    let of = "of the motion below, which does not keep all limits";
    let said = format!("cost J              {cost}, {of}\n");
    assert!(run.stdout.contains(&said), "{said} in\n{}", run.stdout);
    let page = folder.read("out/report.html");
    assert!(
        page.contains(&format!("<td>{cost}<div class=\"meaning\">{of}")),
        "{cost}"
    );
}

/// The same task a million times smaller.
#[test]
fn small_figures_keep_their_digits() {
    let folder = Folder::new(PROBLEM);
    let robot: String = folder.read("robot.toml");
    let mut light = String::new();
    for line in robot.lines() {
        light.push_str(&scaled(line, 1e-9));
        light.push('\n');
    }
    folder.write("robot.toml", &light);
    let run = folder.run(&["plan", "case.toml", "--out", "out"]);
    assert_eq!(run.code, 0, "{run:?}");
    assert!(!run.stdout.contains(" 0.0000 N·m"), "{}", run.stdout);
    let line = run.stdout.lines().find(|line| line.contains("N·m"));
    let mut words = line.unwrap().split_whitespace().rev();
    let peak: f64 = words.nth(1).unwrap().parse().unwrap();
    let saved = solution(&folder)["metrics"]["peak_joint_torque"]
        .as_f64()
        .unwrap();
    assert!(saved > 0.0 && saved < 1e-8, "{saved}");
    assert!((peak / saved - 1.0).abs() < 5e-3, "{peak}, {saved}");
}

/// A line of the robot's file with masses and inertias times `factor`.
fn scaled(line: &str, factor: f64) -> String {
    let mut line = line.to_string();
    for key in ["mass = ", "inertia = "] {
        if let Some(at) = line.find(key).map(|at| at + key.len()) {
            let end = line[at..]
                .find([',', ' ', '}'])
                .map_or(line.len(), |n| at + n);
            if let Ok(value) = line[at..end].parse::<f64>() {
                line.replace_range(at..end, &format!("{:e}", value * factor));
            }
        }
    }
    line
}
