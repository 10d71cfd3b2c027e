//! What `plan` prints and writes.

use crate::program::{Folder, PROBLEM};
use serde_json::Value;

#[test]
fn plan_writes_solution_and_trajectory() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["plan", "case.toml", "--out", "a/b"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{}", run.stdout);
    assert!(
        run.stdout.starts_with("case: solved (a-rpm)\n"),
        "{}",
        run.stdout
    );

    let solution: Value = serde_json::from_str(&folder.read("a/b/solution.json")).unwrap();
    for key in [
        "schema",
        "name",
        "status",
        "method",
        "objective",
        "tolerance",
        "max_error",
        "points",
        "segments",
        "iterations",
        "mesh",
        "trajectory",
        "metrics",
        "verification",
        "diagnosis",
        "timing",
        "provenance",
    ] {
        assert!(solution.get(key).is_some(), "{key}");
    }
    assert_eq!(solution["status"], "solved");
    assert!(
        solution["verification"]["max_base_attitude_drift"]
            .as_f64()
            .unwrap()
            < 1e-3
    );
    assert!(solution["max_error"].as_f64().unwrap() <= 1e-3);
    assert_eq!(solution["provenance"]["problem"]["text"], PROBLEM);
    let points = solution["points"].as_u64().unwrap() as usize;
    let trajectory = solution["trajectory"].as_object().unwrap();
    assert_eq!(trajectory.len(), 9);
    assert_eq!(trajectory["attitude"], "angle");
    for rows in trajectory.values().filter(|rows| !rows.is_string()) {
        assert_eq!(rows.as_array().unwrap().len(), points + 1);
    }
    let t = &trajectory["t"];
    assert_eq!(t[points], 20.0);

    let csv = folder.read("a/b/trajectory.csv");
    let mut lines = csv.lines();
    assert_eq!(
        lines.next().unwrap(),
        "t,eta_1,zeta_1,zeta_2,th_1,th_2,dth_1,dth_2,u_1,u_2,tau_1,tau_2,deta_1"
    );
    assert_eq!(lines.clone().count(), points + 1);
    for (k, line) in lines.enumerate() {
        let values: Vec<f64> = line
            .split(',')
            .map(|value| value.parse().unwrap())
            .collect();
        assert_eq!(values.len(), 13);
        assert_eq!(values[0], t[k].as_f64().unwrap());
        assert_eq!(
            values[4],
            trajectory["joint_position"][k][0].as_f64().unwrap()
        );
    }
}

#[test]
fn only_whole_files_are_left_in_the_default_folder() {
    let folder = Folder::new(PROBLEM);
    for _ in 0..2 {
        assert_eq!(folder.run(&["plan", "case.toml", "--quiet"]).code, 0);
        let mut names: Vec<_> = std::fs::read_dir(folder.path().join("out/case"))
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        assert_eq!(names, ["report.html", "solution.json", "trajectory.csv"]);
    }
}

#[test]
fn json_is_one_document_and_nothing_else() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["plan", "case.toml", "--out", "o", "--json"]);
    assert_eq!(run.code, 0);
    let document: Value = serde_json::from_str(&run.stdout).expect("one JSON document");
    assert_eq!(document["name"], "case");
    assert_eq!(run.stdout, folder.read("o/solution.json"));
    assert!(run.stderr.starts_with("case: solved"), "{}", run.stderr);
}

#[test]
fn quiet_prints_nothing() {
    let run = Folder::new(PROBLEM).run(&["plan", "case.toml", "--quiet"]);
    assert_eq!(
        (run.code, run.stdout.as_str(), run.stderr.as_str()),
        (0, "", "")
    );
}
