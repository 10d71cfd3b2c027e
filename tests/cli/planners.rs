//! Planners side by side, trade-offs.

use crate::program::{Folder, PROBLEM};
use serde_json::Value;

#[test]
fn plan_by_another_planner() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["plan", "case.toml", "--method", "matpm"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{}", run.stdout);
    assert!(
        run.stdout.starts_with("case: solved (matpm)\n"),
        "{}",
        run.stdout
    );
    let solution: Value = serde_json::from_str(&folder.read("out/case/solution.json")).unwrap();
    assert_eq!(solution["method"], "matpm");
    assert_eq!(solution["iterations"].as_array().unwrap().len(), 0);
    assert!(
        solution["verification"]["max_joint_drift"]
            .as_f64()
            .unwrap()
            < 1e-9
    );
    // What was saved is taken up by other commands.
    let path = "out/case/solution.json";
    assert_eq!(folder.run(&["verify", path]).code, 0);
    assert_eq!(
        folder
            .run(&["plan", "case.toml", "--warm-start", path])
            .code,
        0
    );

    let run = folder.run(&["plan", "case.toml", "--method", "reaction-null-space"]);
    assert_eq!(run.code, 3, "{run:?}");
    assert!(run.stdout.contains("single joint path"), "{}", run.stdout);

    folder.write(
        "moving.toml",
        &PROBLEM.replace("final.joints", "initial.rates = [0.1, 0.0]\nfinal.joints"),
    );
    let run = folder.run(&["plan", "moving.toml", "--method", "matpm"]);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{run:?}");
    assert!(
        run.stderr.contains("moving.toml:8: task.initial.rates"),
        "{}",
        run.stderr
    );
}

#[test]
fn compare_sets_every_planner_side_by_side() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["compare", "case.toml", "--out", "all", "--json"]);
    assert_eq!(run.code, 0, "{run:?}");
    let document: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(folder.read("all/compare.json"), run.stdout);
    let rows = document["rows"].as_array().unwrap();
    let row = |method: &str| rows.iter().find(|row| row["method"] == method).unwrap();
    for method in [
        "a-rpm",
        "rpm",
        "base-rate",
        "matpm",
        "straight-line",
        "acceleration-qp",
    ] {
        assert_eq!(row(method)["status"], "solved", "{method}");
        let path = format!("all/{method}/solution.json");
        let solution: Value = serde_json::from_str(&folder.read(&path)).unwrap();
        assert_eq!(
            solution["metrics"]["final_base_attitude"],
            row(method)["final_base_attitude"]
        );
    }
    assert_eq!(rows.len(), 7);
    let missed = row("reaction-null-space");
    assert_eq!(missed["status"], "infeasible");
    assert!(
        missed["reason"]
            .as_str()
            .unwrap()
            .contains("single joint path")
    );
    // No other planner has a lower cost than the one that minimises it.
    let cost = |method: &str| row(method)["objective"].as_f64().unwrap();
    for method in ["base-rate", "matpm", "straight-line", "acceleration-qp"] {
        assert!(cost("a-rpm") < cost(method), "{method}");
    }
    let table = folder.read("all/compare.md");
    assert!(table.contains("| matpm "), "{table}");
    assert!(run.stderr.contains(&table[..200]), "{}", run.stderr);
    assert_eq!(folder.read("all/compare.csv").lines().count(), 8);
    let figure = folder.read("all/compare.svg");
    for part in [
        "Base attitude",
        "Base displacement",
        "shoulder",
        "acceleration-qp",
        "stroke-dasharray",
    ] {
        assert!(figure.contains(part), "{part}");
    }
    assert!(folder.path().join("all/compare.png").exists());
}

#[test]
fn compare_gives_joint_goals_to_planners_that_need_them() {
    let goal = "final.end_effector = { frame = \"start\", position = [0.9, 0.4], position_tolerance = 0.3 }";
    let folder = Folder::new(&PROBLEM.replace("final.joints = [0.5, 1.0]", goal));
    let run = folder.run(&["compare", "case.toml", "--json"]);
    assert_eq!(run.code, 0, "{run:?}");
    let document: Value = serde_json::from_str(&run.stdout).unwrap();
    assert!(
        document["notes"][0]
            .as_str()
            .unwrap()
            .contains("goal for the end effector")
    );
    let [a, b] = ["a-rpm", "matpm"].map(|method| {
        let path = format!("out/case-compare/{method}/solution.json");
        let solution: Value = serde_json::from_str(&folder.read(&path)).unwrap();
        let rows = solution["trajectory"]["joint_position"]
            .as_array()
            .unwrap()
            .clone();
        rows.last().unwrap()[1].as_f64().unwrap()
    });
    assert!((a - b).abs() < 1e-9, "{a} {b}");
}

#[test]
fn pareto_trades_base_motion_for_joint_effort() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&[
        "pareto",
        "case.toml",
        "--points",
        "4",
        "--fill",
        "0",
        "--out",
        "front",
        "--json",
    ]);
    assert_eq!(run.code, 0, "{run:?}");
    let document: Value = serde_json::from_str(&run.stdout).unwrap();
    let rows = document["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 4);
    let column =
        |key: &str| -> Vec<f64> { rows.iter().map(|row| row[key].as_f64().unwrap()).collect() };
    let [factors, base, joints] = ["factor", "base_motion", "joint_effort"].map(column);
    assert_eq!((factors[0], factors[3]), (0.01, 100.0));
    for k in 1..4 {
        assert!(
            base[k] < base[k - 1] && joints[k] > joints[k - 1],
            "{base:?} {joints:?}"
        );
        assert!((factors[k] / factors[k - 1] - 1e4f64.cbrt()).abs() < 1e-9);
    }
    for name in [
        "pareto.html",
        "pareto.md",
        "pareto.csv",
        "pareto.json",
        "pareto.svg",
        "pareto.png",
    ] {
        assert!(folder.path().join("front").join(name).exists(), "{name}");
    }
    let run = folder.run(&["pareto", "case.toml", "--from", "2", "--to", "1"]);
    assert_eq!(run.code, 2);
    assert_eq!(run.stderr, "--from 2 is not below --to 1\n");
}

#[test]
fn pareto_fills_gaps_and_searches_within_its_time() {
    let folder = Folder::new(PROBLEM);
    let began = std::time::Instant::now();
    let run = folder.run(&[
        "pareto",
        "case.toml",
        "--points",
        "3",
        "--fill",
        "2",
        "--search",
        "2",
        "--time-limit",
        "60",
        "--json",
    ]);
    assert_eq!(run.code, 0, "{run:?}");
    assert!(began.elapsed().as_secs() < 60);
    let document: Value = serde_json::from_str(&run.stdout).unwrap();
    let rows = document["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 5, "{rows:?}");
    let column = |key: &'static str| rows.iter().map(move |row| row[key].as_f64().unwrap());
    assert!(column("factor").is_sorted());
    assert!(column("base_motion").map(|base| -base).is_sorted());
    assert!(column("joint_effort").is_sorted());
    // The further points are at the middle of two factors.
    let of_sweep = |factor: &f64| {
        let places = [0.01, 1.0, 100.0];
        places
            .iter()
            .any(|place| (factor / place - 1.0).abs() < 1e-9)
    };
    assert_eq!(column("factor").filter(of_sweep).count(), 3);
    let refused = folder.run(&["pareto", "case.toml", "--time-limit", "0"]);
    assert_eq!(refused.code, 2);
}

#[test]
fn a_comparison_takes_a_search_for_its_own_planner() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["compare", "case.toml", "--search", "3"]);
    assert_eq!(run.code, 0, "{run:?}");
    let of = |method: &str| -> Value {
        let path = format!("out/case-compare/{method}/solution.json");
        serde_json::from_str(&folder.read(&path)).unwrap()
    };
    assert_eq!(of("a-rpm")["search"]["tried"], 3);
    assert!(of("matpm")["search"].is_null());
}

#[test]
fn a_search_lists_what_it_found() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["plan", "case.toml", "--search", "4", "--seed", "7"]);
    assert_eq!(run.code, 0, "{run:?}");
    assert!(
        run.stdout.contains("search: 4 starts, ") && run.stdout.contains("others may exist"),
        "{}",
        run.stdout
    );
    let solution: Value = serde_json::from_str(&folder.read("out/case/solution.json")).unwrap();
    let search = &solution["search"];
    assert_eq!((&search["tried"], &search["seed"]), (&4.into(), &7.into()));
    assert_eq!(search["optima"][0]["status"], "solved");
    assert_eq!(search["optima"][0]["objective"], solution["objective"]);
    assert!(folder.read("out/case/report.html").contains("Other optima"));
    // Without a search there is none.
    folder.run(&["plan", "case.toml"]);
    let solution: Value = serde_json::from_str(&folder.read("out/case/solution.json")).unwrap();
    assert!(solution["search"].is_null());
}

#[test]
fn a_search_that_cannot_be_is_refused() {
    let folder = Folder::new(PROBLEM);
    for (arguments, said) in [
        (&["--search", "0"][..], "expected a number of starts"),
        (&["--seed", "2"], "--search"),
        (
            &["--search", "--method", "matpm"],
            "--search with --method matpm",
        ),
    ] {
        let run = folder.run(&[&["plan", "case.toml"], arguments].concat());
        assert_eq!(run.code, 2, "{run:?}");
        assert!(run.stderr.contains(said), "{}", run.stderr);
        assert!(!folder.path().join("out").exists(), "{arguments:?}");
    }
}
