//! What can be varied, and that it is what the plans were made of.

use crate::program::{PROBLEM, edited};
use crate::rows::*;

#[test]
fn grids_tables_and_text() {
    let folder = folder(
        r#"schema = 1
problem = "case.toml"
[[vary]]
key = "task.final.joints"
values = [[0.5, 1.0], [0.4, 0.8]]
[[vary]]
key = "mesh.method"
values = ["a-rpm", "rpm"]
[[vary]]
key = "task.duration"
table = "t.csv"
column = "seconds"
"#,
    );
    folder.write("t.csv", "name, seconds\na, 20\nb, 25.5\n");
    plan(&folder, "o", &["--trajectories"]);
    let found = rows(&folder, "o");
    let durations = [20.0, 20.0, 20.0, 20.0, 25.5, 25.5, 25.5, 25.5];
    assert_eq!(numbers(&found, "task.duration"), durations);
    let of = |name: &str| {
        found
            .values()
            .map(|row| row[name].clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(of("mesh.method")[..3], ["a-rpm", "rpm", "a-rpm"]);
    assert_eq!(of("segments")[1], "1");
    assert_eq!(of("task.final.joints")[3], "Some([0.4, 0.8])");
    // The motions are those of the values.
    for row in found.values() {
        let last = |name: &str| {
            let numbers = row[name].trim_end_matches(['[', ']', ')']);
            numbers
                .rsplit([',', '['])
                .next()
                .unwrap()
                .trim()
                .parse::<f64>()
                .unwrap()
        };
        let duration: f64 = row["task.duration"].parse().unwrap();
        assert!((last("t") - duration).abs() < 1e-9);
        let goal = last("task.final.joints");
        assert!((last("joint_position") - goal).abs() < 1e-6, "{goal}");
    }
    // The data set itself is a table.
    folder.write(
        "again.toml",
        "schema = 1\nproblem = \"case.toml\"\n[[vary]]\nkey = \"task.duration\"\n\
         table = \"o/part-000000.parquet\"\ncolumn = \"task.duration\"\n",
    );
    let run = folder.run(&["batch", "again.toml", "--out", "again", "--quiet"]);
    assert_eq!(run.code, 0, "{run:?}");
    assert_eq!(numbers(&rows(&folder, "again"), "task.duration"), durations);
}

#[test]
fn correlated_values() {
    let folder = folder(
        r#"schema = 1
problem = "case.toml"
count = 40
[[vary]]
keys = ["robot.bodies.forearm.mass", "task.final.joints[0]"]
normal = { mean = [1.4, 0.35], covariance = [[0.01, 0.0018], [0.0018, 0.0004]] }
"#,
    );
    plan(&folder, "o", &[]);
    let found = rows(&folder, "o");
    let mass = numbers(&found, "robot.bodies.forearm.mass");
    let goal = numbers(&found, "task.final.joints[0]");
    let mean = |values: &[f64]| values.iter().sum::<f64>() / 40.0;
    let (m, c) = (mean(&mass), mean(&goal));
    let sum = |a: &[f64], a0: f64, b: &[f64], b0: f64| {
        a.iter()
            .zip(b)
            .map(|(a, b)| (a - a0) * (b - b0))
            .sum::<f64>()
    };
    let both = sum(&mass, m, &goal, c) / (sum(&mass, m, &mass, m) * sum(&goal, c, &goal, c)).sqrt();
    // 0.9 is meant; five standard errors of Fisher's transform at 40 samples leave 0.6.
    assert!(both > 0.6, "{both}");
    assert!(
        (m - 1.4).abs() < 0.08 && (c - 0.35).abs() < 0.016,
        "{m}, {c}"
    );
}

#[test]
fn json_lines_of_whole_problems() {
    let folder = folder(BATCH);
    let problem: toml::Value = toml::from_str(PROBLEM).unwrap();
    let json = serde_json::to_string(&problem).unwrap();
    let other = json.replace("\"duration\":20.0", "\"duration\":30.0");
    folder.write(
        "p.jsonl",
        &format!(
            "\u{feff}{json}\n\n{other}\n{{\"schema\": 1}}\nno JSON\n{{\"schema\": 1, \"schema\": 1}}\n"
        ),
    );
    let run = folder.run(&[
        "batch",
        "p.jsonl",
        "--out",
        "o",
        "--quiet",
        "--trajectories",
        "--solutions",
        "0-00000001",
    ]);
    assert_eq!(run.code, 0, "{run:?}");
    let found = rows(&folder, "o");
    let of = |name: &str| {
        found
            .values()
            .map(|row| row[name].clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(
        of("status"),
        ["solved", "solved", "malformed", "malformed", "malformed"]
    );
    assert_eq!(of("name")[..2], ["case", "case"]);
    assert!(of("t")[1].ends_with(", 30.0])"), "{}", of("t")[1]);
    assert_eq!(
        of("reason")[2],
        "p.jsonl:4: robot: missing; expected the path of a robot file, relative to this one"
    );
    assert!(
        of("reason")[3].starts_with("p.jsonl:5: not JSON: "),
        "{}",
        of("reason")[3]
    );
    assert!(
        of("reason")[4].contains("the key \"schema\" stands twice"),
        "{}",
        of("reason")[4]
    );
    // Another robot makes other rows.
    let robot = folder.read("robot.toml");
    folder.write(
        "robot.toml",
        &edited(&robot, "mass = 15.20", "mass = 15.21"),
    );
    let run = folder.run(&[
        "batch",
        "p.jsonl",
        "--out",
        "o",
        "--trajectories",
        "--resume",
    ]);
    assert!(
        run.code == 2 && run.stderr.contains("has rows of another batch"),
        "{run:?}"
    );
    folder.write("robot.toml", &robot);
    // Saved with a text of its own, it can be planned again.
    let verified = folder.run(&[
        "verify",
        "o/solutions/0-00000001/solution.json",
        "--out",
        "v",
    ]);
    assert_eq!(verified.code, 0, "{verified:?}");
}

/// The library's way to a row.
#[test]
fn a_row_is_made_by_itself() {
    let folder = folder(BATCH);
    let path = folder.path().join("batch.toml");
    let batch = ffsm_ipopt::config::BatchFile::load(&path, None).unwrap();
    let row = batch.row(11).unwrap();
    let mass = row.file.problem.robot.joints()[1].body.inertia.mass();
    assert_eq!(row.cells[1], ffsm_ipopt::config::Cell::Number(mass));
    assert_eq!(batch.key(11), "5-00000011");
    let distinct: std::collections::HashSet<u64> = (0..12)
        .map(|i| {
            batch
                .row(i)
                .unwrap()
                .file
                .problem
                .robot
                .total_mass()
                .to_bits()
        })
        .collect();
    assert_eq!(distinct.len(), 12);
}
