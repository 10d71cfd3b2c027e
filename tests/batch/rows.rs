//! Batches to plan, and the rows that came of them.

use crate::program::{Folder, PROBLEM, Run};
use ffsm_ipopt::solution::dataset::{Column, Data, DataSet};
use std::collections::BTreeMap;
use std::process::{Child, Command, Stdio};

/// Twelve variations of the test problem.
pub const BATCH: &str = r#"schema = 1
problem = "case.toml"
seed = 5
count = 12

[[vary]]
key = "task.final.joints[0]"
uniform = [0.3, 0.7]

[[vary]]
key = "robot.bodies.forearm.mass"
normal = { mean = 1.4, sd = 0.2, min = 1.0 }

[[vary]]
key = "limits.joint_velocity"
values = [0.9, 0.8, 0.7]
"#;

/// A folder with the test problem and `batch.toml`.
pub fn folder(batch: &str) -> Folder {
    let folder = Folder::new(PROBLEM);
    folder.write("batch.toml", batch);
    folder
}

/// Plans `batch.toml` to the folder `out`, which has to succeed.
#[track_caller]
pub fn plan(folder: &Folder, out: &str, arguments: &[&str]) -> Run {
    let run = folder.run(&[&["batch", "batch.toml", "--out", out, "--quiet"], arguments].concat());
    assert_eq!(run.code, 0, "{run:?}");
    run
}

/// A row: its values by the names of their columns, every bit of a number told. Times are left out.
pub type Row = BTreeMap<String, String>;

/// The rows in `out`, by their positions. No position is there twice.
#[track_caller]
pub fn rows(folder: &Folder, out: &str) -> BTreeMap<i64, Row> {
    let set = DataSet::open(&folder.path().join(out)).expect("a data set");
    let mut all = BTreeMap::new();
    let names: Vec<String> = NAMES.iter().map(|name| name.to_string()).collect();
    let keys = set.manifest().keys.iter().map(|(name, _)| name.clone());
    let names: Vec<String> = names.into_iter().chain(keys).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    set.read(&names, &mut |columns| {
        let count = columns[0].data.len();
        for i in 0..count {
            let row: Row = columns
                .iter()
                .map(|column| (column.name.clone(), value(column, i)))
                .collect();
            let position = row["row"].parse().expect("a position");
            assert!(all.insert(position, row).is_none(), "row {position} twice");
        }
    })
    .expect("parts that can be read");
    all
}

/// All columns but the times and the keys that vary.
const NAMES: [&str; 31] = [
    "row",
    "key",
    "name",
    "status",
    "reason",
    "objective",
    "max_error",
    "points",
    "segments",
    "mesh_iterations",
    "nlp_iterations",
    "max_base_attitude",
    "final_base_attitude",
    "max_base_displacement",
    "final_base_displacement",
    "peak_joint_velocity",
    "peak_joint_torque",
    "goal_distance",
    "goal_angle",
    "verification_attitude",
    "verification_position",
    "verification_joint",
    "linear_solver",
    "t",
    "base_attitude",
    "base_position",
    "base_rate",
    "joint_position",
    "joint_velocity",
    "control",
    "joint_torque",
];

fn value(column: &Column, i: usize) -> String {
    match &column.data {
        Data::Text(values) => values[i].clone().unwrap_or_default(),
        Data::Integer(values) => values[i].map_or(String::new(), |value| value.to_string()),
        Data::Number(values) => values[i].map_or(String::new(), |value| format!("{value:?}")),
        Data::Numbers(values) => format!("{:?}", values[i]),
        Data::Rows(values) => format!("{:?}", values[i]),
        _ => unreachable!("no other kind"),
    }
}

/// The numbers of a column.
pub fn numbers(rows: &BTreeMap<i64, Row>, column: &str) -> Vec<f64> {
    let value = |row: &Row| row[column].parse().expect("a number");
    rows.values().map(value).collect()
}

/// Begins a batch of many rows, for those who end it.
pub fn begin(folder: &Folder, out: &str, arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_ffsm-ipopt"))
        .args(["batch", "batch.toml", "--out", out, "--quiet"])
        .args(arguments)
        .current_dir(folder.path())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program runs")
}

/// Waits until there is a part in `out`.
pub fn wait_for_part(folder: &Folder, out: &str) {
    for _ in 0..3000 {
        let entries = std::fs::read_dir(folder.path().join(out))
            .into_iter()
            .flatten();
        let mut names = entries.map(|entry| entry.unwrap().file_name());
        if names.any(|name| name.to_string_lossy().starts_with("part-")) {
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    panic!("no part within half a minute");
}
