//! `sample` and `export`: what other tools get is the plan.

use crate::program::{Folder, PROBLEM};
use std::path::Path;

/// A table of CSV: header and rows.
fn table(text: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().unwrap().iter().map(str::to_owned);
    let header = header.collect();
    let number = |cell: &str| cell.parse::<f64>().unwrap();
    let rows = reader.records();
    let rows = rows.map(|row| row.unwrap().iter().map(number).collect());
    (header, rows.collect())
}

fn planned() -> Folder {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["plan", "case.toml", "--out", ".", "--quiet", "--no-report"]);
    assert_eq!(run.code, 0, "{run:?}");
    folder
}

/// The columns of one quantity.
fn of(header: &[String], row: &[f64], start: &str) -> Vec<f64> {
    let columns = header.iter().zip(row);
    let columns = columns.filter(|(name, _)| name.starts_with(start));
    columns.map(|(_, value)| *value).collect()
}

#[test]
fn samples_are_the_plan_at_even_times() {
    let folder = planned();
    let run = folder.run(&["sample", "solution.json", "--rate", "10"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    let (header, rows) = table(&folder.read("motion.csv"));
    assert_eq!(rows.len(), 201);
    for name in [
        "time [s]",
        "base_position.x [m]",
        "base_quaternion.w [1]",
        "base_velocity.z [m/s]",
        "base_angular_velocity.z [rad/s]",
        "joint_position.shoulder [rad]",
        "joint_velocity.elbow [rad/s]",
        "joint_acceleration.elbow [rad/s^2]",
        "control.shoulder [rad/s^2]",
        "joint_torque.shoulder [N m]",
    ] {
        assert!(
            header.iter().any(|column| column == name),
            "{name}: {header:?}"
        );
    }
    for (k, row) in rows.iter().enumerate() {
        assert!((row[0] - 0.1 * k as f64).abs() < 1e-12, "{}", row[0]);
    }
    let ends = [[0.0, 0.0], [0.5, 1.0]];
    for (row, expected) in [&rows[0], &rows[200]].into_iter().zip(ends) {
        let found = of(&header, row, "joint_position.");
        assert!(
            found
                .iter()
                .zip(expected)
                .all(|(a, b)| (a - b).abs() < 1e-9),
            "{found:?}"
        );
    }
    // Rates are slopes: of the joints, and of the base.
    let central = |quantity: &str, k: usize| -> Vec<f64> {
        let [before, after] = [k - 1, k + 1].map(|k| of(&header, &rows[k], quantity));
        before
            .iter()
            .zip(after)
            .map(|(a, b)| (b - a) / 0.2)
            .collect()
    };
    for k in (20..190).step_by(10) {
        for (quantity, rate) in [
            ("joint_position.", "joint_velocity."),
            ("joint_velocity.", "joint_acceleration."),
            ("base_position.", "base_velocity."),
        ] {
            let (slopes, rates) = (central(quantity, k), of(&header, &rows[k], rate));
            for (slope, rate) in slopes.iter().zip(&rates) {
                assert!(
                    (slope - rate).abs() < 2e-4,
                    "{quantity} {k}: {slope}, {rate}"
                );
            }
        }
        // In the plane the base turns about z by twice the angle of the quaternion.
        let turn = |k: usize| {
            let q = of(&header, &rows[k], "base_quaternion.");
            2.0 * q[3].atan2(q[0])
        };
        let slope = (turn(k + 1) - turn(k - 1)) / 0.2;
        let rate = of(&header, &rows[k], "base_angular_velocity.")[2];
        assert!((slope - rate).abs() < 2e-4, "{k}: {slope}, {rate}");
    }
}

#[test]
fn a_plan_is_sampled_as_it_is_made() {
    let folder = planned();
    folder.run(&[
        "sample",
        "solution.json",
        "--rate",
        "7",
        "--out",
        "later.csv",
    ]);
    let run = folder.run(&[
        "plan",
        "case.toml",
        "--out",
        ".",
        "--quiet",
        "--sample",
        "7",
    ]);
    assert_eq!(run.code, 0, "{run:?}");
    assert_eq!(folder.read("motion.csv"), folder.read("later.csv"));
    // What an earlier plan left does not stay beside a new one.
    folder.run(&["plan", "case.toml", "--out", ".", "--quiet", "--no-report"]);
    let names = folder.names();
    for gone in ["motion.csv", "report.html"] {
        assert!(!names.iter().any(|name| name == gone), "{names:?}");
    }
}

/// What `joint_trajectory_controller` asks of a trajectory before it follows it.
#[test]
fn trajectories_are_such_as_controllers_take() {
    let folder = planned();
    let export = ["export", "solution.json", "--format", "joint-trajectory"];
    for rate in [&[][..], &["--rate", "30"]] {
        let run = folder.run(&[&export[..], rate].concat());
        assert_eq!(run.code, 0, "{run:?}");
        let text = folder.read("follow_joint_trajectory.yaml");
        let values = |line: &str| -> Vec<f64> {
            serde_json::from_str(line.split_once(": ").unwrap().1).unwrap()
        };
        let all = |key: &str| -> Vec<Vec<f64>> {
            let lines = text.lines().filter(|line| line.contains(key));
            lines.map(values).collect()
        };
        let rates = all(" velocities: ");
        assert!(rates.len() > 10 && rates.iter().flatten().any(|rate| rate.abs() > 0.01));
        let rest = f64::from(f32::EPSILON);
        assert!(rates.last().unwrap().iter().all(|rate| rate.abs() <= rest));
        assert!(all(" effort: ").iter().all(Vec::is_empty));
    }
    let run = folder.run(&[&export[..], &["--effort"]].concat());
    assert_eq!(run.code, 0, "{run:?}");
    let text = folder.read("joint_trajectory.yaml");
    let efforts = text.lines().filter(|line| line.contains(" effort: "));
    assert!(efforts.clone().all(|line| line.contains(", ")) && efforts.count() > 10);
    let run = folder.run(&["export", "solution.json", "--format", "csv", "--effort"]);
    assert_eq!(
        (run.code, run.stderr.as_str()),
        (
            2,
            "--effort: expected with --format joint-trajectory alone\n"
        )
    );
}

#[test]
fn every_format_is_written() {
    let folder = planned();
    for (format, files) in [
        ("csv", &["motion.csv"][..]),
        ("parquet", &["motion.parquet"]),
        (
            "joint-trajectory",
            &["joint_trajectory.yaml", "follow_joint_trajectory.yaml"],
        ),
        (
            "mujoco",
            &["mujoco/model.xml", "mujoco/motion.csv", "mujoco/play.py"],
        ),
    ] {
        let run = folder.run(&[
            "export",
            "solution.json",
            "--format",
            format,
            "--out",
            "for-others",
        ]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
        for file in files {
            let path = folder.path().join("for-others").join(file);
            assert!(path.metadata().unwrap().len() > 100, "{file}");
            assert!(run.stdout.contains(file), "{file}: {}", run.stdout);
        }
    }
    // Without a rate, the nodes.
    let (_, rows) = table(&folder.read("for-others/motion.csv"));
    let (_, nodes) = table(&folder.read("trajectory.csv"));
    let times = |rows: &[Vec<f64>]| rows.iter().map(|row| row[0]).collect::<Vec<_>>();
    assert_eq!(times(&rows), times(&nodes));
}

#[test]
fn rates_and_names_that_cannot_be_are_refused() {
    let folder = planned();
    let before = folder.names();
    for (arguments, said) in [
        (
            &["sample", "solution.json", "--rate", "0"][..],
            "a positive number",
        ),
        (
            &["sample", "solution.json", "--rate", "-5"],
            "a positive number",
        ),
        (
            &["sample", "solution.json", "--rate", "NaN"],
            "a positive number",
        ),
        (
            &["sample", "solution.json", "--rate", "1e9"],
            "1000000 rows",
        ),
        (
            &["sample", "solution.json", "--rate", "9", "--out", "x.xlsx"],
            "ends in .csv or .parquet",
        ),
        (&["sample", "none.json", "--rate", "9"], "none.json"),
        (
            &[
                "export",
                "solution.json",
                "--format",
                "csv",
                "--rate",
                "inf",
            ],
            "a positive number",
        ),
        (
            &["export", "solution.json", "--format", "xlsx"],
            "joint-trajectory",
        ),
        (&["plan", "case.toml", "--sample", "0"], "a positive number"),
        (&["plan", "case.toml", "--sample", "1e9"], "1000000 rows"),
    ] {
        let run = folder.run(arguments);
        assert_eq!(run.code, 2, "{arguments:?}: {run:?}");
        assert!(run.stderr.contains(said), "{arguments:?}: {}", run.stderr);
    }
    assert_eq!(folder.names(), before);
}

#[test]
fn a_plan_that_is_not_solved_is_written_with_a_word() {
    let folder =
        Folder::new(&PROBLEM.replace("tolerance = 1e-3", "tolerance = 1e-12\nmax_iterations = 1"));
    let run = folder.run(&["plan", "case.toml", "--out", ".", "--quiet"]);
    assert_eq!(run.code, 4, "{run:?}");
    let run = folder.run(&["export", "solution.json", "--format", "joint-trajectory"]);
    assert_eq!(run.code, 4, "{run:?}");
    assert!(
        run.stderr.contains("the plan is not converged"),
        "{}",
        run.stderr
    );
    assert!(folder.path().join("joint_trajectory.yaml").is_file());
}

#[test]
fn names_of_a_hostile_robot_stay_names() {
    let folder = planned();
    let hostile = "a\\\"]\\nb: [<x/>&";
    let robot = std::fs::read_to_string(
        Path::new(env!("CARGO_MANIFEST_DIR")).join("config/robots/planar-2link.toml"),
    )
    .unwrap();
    folder.write(
        "robot.toml",
        &robot.replace("\"shoulder\"", &format!("\"{hostile}\"")),
    );
    let run = folder.run(&["plan", "case.toml", "--out", ".", "--quiet"]);
    assert_eq!(run.code, 0, "{run:?}");
    for format in ["csv", "joint-trajectory", "mujoco"] {
        let run = folder.run(&["export", "solution.json", "--format", format]);
        assert_eq!(run.code, 0, "{run:?}");
    }
    let model = folder.read("mujoco/model.xml");
    assert!(!model.contains("<x/>"), "{model}");
    let message = folder.read("joint_trajectory.yaml");
    let names = message
        .lines()
        .find(|line| line.starts_with("joint_names"))
        .unwrap();
    let names = names.split_once(": ").unwrap().1;
    let names: Vec<String> = serde_json::from_str(names).unwrap();
    assert_eq!(names.len(), 2);
}
