//! The same rows for any number of jobs, of shards, of rows, in threads and in processes, and those
//! of `plan`.

use crate::program::edited;
use crate::rows::*;
use serde_json::Value;

#[test]
fn rows_do_not_depend_on_who_plans_them() {
    let folder = folder(BATCH);
    plan(&folder, "one", &["--jobs", "1"]);
    let expected = rows(&folder, "one");
    assert_eq!(expected.len(), 12);
    assert!(expected.values().all(|row| row["status"] == "solved"));
    plan(&folder, "three", &["--jobs", "3"]);
    assert_eq!(rows(&folder, "three"), expected);
    plan(&folder, "isolated", &["--isolate", "--jobs", "2"]);
    assert_eq!(rows(&folder, "isolated"), expected);
    for shard in ["2/3", "3/3", "1/3"] {
        plan(&folder, "shards", &["--shard", shard]);
    }
    assert_eq!(rows(&folder, "shards"), expected);
}

#[test]
fn more_rows_begin_with_the_same() {
    let folder = folder(BATCH);
    plan(&folder, "o", &[]);
    let first = rows(&folder, "o");
    folder.write("batch.toml", &edited(BATCH, "count = 12", "count = 15"));
    plan(&folder, "o", &["--resume"]);
    let mut more = rows(&folder, "o");
    plan(&folder, "p", &[]);
    assert_eq!(rows(&folder, "p"), more);
    assert_eq!(more.len(), 15);
    more.retain(|row, _| *row < 12);
    assert_eq!(more, first);
}

#[test]
fn a_row_is_the_plan_of_its_problem_alone() {
    let folder = folder(BATCH);
    plan(&folder, "o", &["--trajectories", "--jobs", "2"]);
    let rows = rows(&folder, "o");
    for position in [0, 7] {
        let row = &rows[&position];
        let key = |name: &str| format!("{name}={}", row[name]);
        let run = folder.run(&[
            "plan",
            "case.toml",
            "--out",
            "alone",
            "--quiet",
            "--json",
            "--set",
            &key("task.final.joints[0]"),
            "--set",
            &key("robot.bodies.forearm.mass"),
            "--set",
            &key("limits.joint_velocity"),
        ]);
        assert_eq!(run.code, 0, "{run:?}");
        let alone: Value = serde_json::from_str(&run.stdout).unwrap();
        let number = |value: &Value| format!("{:?}", value.as_f64().unwrap());
        for name in ["objective", "max_error"] {
            assert_eq!(row[name], number(&alone[name]), "{name}");
        }
        for (name, value) in alone["metrics"].as_object().unwrap() {
            assert_eq!(row[name], number(value), "{name}");
        }
        for name in ["points", "segments"] {
            assert_eq!(row[name], alone[name].to_string(), "{name}");
        }
        let drift = &alone["verification"]["max_base_attitude_drift"];
        assert_eq!(row["verification_attitude"], number(drift));
        let t: Vec<f64> = serde_json::from_value(alone["trajectory"]["t"].clone()).unwrap();
        assert_eq!(row["t"], format!("{:?}", Some(t)));
        for name in [
            "base_attitude",
            "base_position",
            "base_rate",
            "joint_position",
            "joint_velocity",
            "control",
            "joint_torque",
        ] {
            let of = alone["trajectory"][name].clone();
            let of: Vec<Vec<f64>> = serde_json::from_value(of).unwrap();
            assert_eq!(row[name], format!("{:?}", Some(of)), "{name}");
        }
    }
}

/// All plans from one saved solution, as `plan` starts from it.
#[test]
fn warm_starts_are_those_of_plan() {
    let folder = folder(&edited(BATCH, "count = 12", "count = 6"));
    assert_eq!(
        folder
            .run(&["plan", "case.toml", "--out", "w", "--quiet"])
            .code,
        0
    );
    let warm = ["--warm-start", "w/solution.json"];
    plan(&folder, "one", &[&warm[..], &["--jobs", "1"]].concat());
    plan(
        &folder,
        "two",
        &[&warm[..], &["--jobs", "2", "--isolate"]].concat(),
    );
    let rows_of = |out| rows(&folder, out);
    assert_eq!(rows_of("one"), rows_of("two"));
    plan(&folder, "cold", &[]);
    let sum = |out| numbers(&rows_of(out), "nlp_iterations").iter().sum::<f64>();
    assert!(sum("one") < sum("cold"), "{} {}", sum("one"), sum("cold"));
    let row = &rows_of("one")[&4];
    let key = |name: &str| format!("{name}={}", row[name]);
    let run = folder.run(&[
        "plan",
        "case.toml",
        "--out",
        "alone",
        "--quiet",
        "--json",
        "--warm-start",
        "w/solution.json",
        "--set",
        &key("task.final.joints[0]"),
        "--set",
        &key("robot.bodies.forearm.mass"),
        "--set",
        &key("limits.joint_velocity"),
    ]);
    let alone: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(
        row["objective"],
        format!("{:?}", alone["objective"].as_f64().unwrap())
    );
}

/// With the limit on the time, which no plan here needs, as without.
#[test]
fn a_time_limit_that_is_not_reached_changes_nothing() {
    let folder = folder(&edited(BATCH, "count = 12", "count = 3"));
    plan(&folder, "o", &[]);
    plan(&folder, "limited", &["--time-limit", "60"]);
    assert_eq!(rows(&folder, "limited"), rows(&folder, "o"));
}

/// The script for Slurm, given what Slurm gives it.
#[test]
fn tasks_of_a_job_array_share_the_rows() {
    let folder = folder(BATCH);
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/scripts/slurm-array.sh");
    let task = |id: &str| {
        std::process::Command::new("bash")
            .args([script, "batch.toml", "o"])
            .env("FFSM_IPOPT", env!("CARGO_BIN_EXE_ffsm-ipopt"))
            .env("SLURM_ARRAY_TASK_ID", id)
            .env("SLURM_ARRAY_TASK_COUNT", "2")
            .current_dir(folder.path())
            .spawn()
            .unwrap()
    };
    let tasks = ["1", "2"].map(task);
    for mut task in tasks {
        assert!(task.wait().unwrap().success());
    }
    plan(&folder, "whole", &[]);
    assert_eq!(rows(&folder, "o"), rows(&folder, "whole"));
}
