//! Saved plans: warm starts, `verify`, `simulate`.

use crate::program::{Folder, PROBLEM};
use serde_json::Value;

#[test]
fn a_saved_solution_is_a_start() {
    let folder = Folder::new(PROBLEM);
    assert_eq!(
        folder
            .run(&["plan", "case.toml", "--out", "a", "--quiet"])
            .code,
        0
    );
    let run = folder.run(&[
        "plan",
        "case.toml",
        "--out",
        "b",
        "--quiet",
        "--warm-start",
        "a/solution.json",
    ]);
    assert_eq!(run.code, 0, "{run:?}");
    let read = |name| serde_json::from_str::<Value>(&folder.read(name)).unwrap();
    let (cold, warm) = (read("a/solution.json"), read("b/solution.json"));
    assert_eq!(warm["iterations"].as_array().unwrap().len(), 1);
    assert_eq!(warm["points"], cold["points"]);
    let difference = warm["objective"].as_f64().unwrap() - cold["objective"].as_f64().unwrap();
    assert!(difference.abs() < 1e-9, "{difference}");
}

#[test]
fn a_saved_plan_is_verified_without_its_files() {
    let folder = Folder::new(PROBLEM);
    let plan = [
        "plan",
        "case.toml",
        "--set",
        "task.duration=15",
        "--tolerance",
        "1e-4",
        "--out",
        "a",
        "--quiet",
    ];
    assert_eq!(folder.run(&plan).code, 0);
    // Everything needed is kept in the solution.
    std::fs::remove_file(folder.path().join("case.toml")).unwrap();
    std::fs::remove_file(folder.path().join("robot.toml")).unwrap();
    let run = folder.run(&["verify", "a/solution.json", "--out", "b"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert!(
        run.stdout.starts_with("case: planned (solved), "),
        "{}",
        run.stdout
    );
    let saved: Value = serde_json::from_str(&folder.read("a/solution.json")).unwrap();
    let found: Value = serde_json::from_str(&folder.read("b/verification.json")).unwrap();
    assert_eq!(found["verification"], saved["verification"]);

    let damage = |from: &str, to: &str| {
        let text = folder.read("a/solution.json");
        assert!(text.contains(from), "{from}");
        folder.write("damaged.json", &text.replacen(from, to, 1));
        let run = folder.run(&["verify", "damaged.json"]);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{to}");
        assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
        run.stderr
    };
    let found = damage("mass = 1.70", "mass = 1.71");
    assert!(
        found.starts_with("damaged.json: provenance.robot: "),
        "{found}"
    );
    let found = damage("--set task.duration=15", "--set task.durration=15");
    assert!(
        found.contains("provenance: ") && found.contains("did you mean 'duration'?"),
        "{found}"
    );
}

#[test]
fn a_saved_plan_is_simulated() {
    let folder = Folder::new(PROBLEM);
    let plan = ["plan", "case.toml", "--out", "a", "--quiet"];
    assert_eq!(folder.run(&plan).code, 0);
    folder.write(
        "table.toml",
        "schema = 1\nseed = 5\n[floor]\ntilt = [1e-5, 0.0]\n\
         [air]\ndrag_area = { base = 0.1 }\n[[pads]]\nbody = \"forearm\"\n\
         [actuator]\ntorque_noise = 1e-3\ndelay = 2e-3\n\
         [capture]\nrate = 10\nposition_noise = 1e-4\n",
    );
    let simulate = |more: &[&str]| {
        let run = folder.run(&[&["simulate", "a/solution.json", "table.toml"], more].concat());
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        run.stdout
    };
    let printed = simulate(&["--repeat", "3"]);
    assert!(
        printed.starts_with("case on table: 3 runs, seed 5\n"),
        "{printed}"
    );
    assert!(printed.contains("largest attitude"), "{printed}");
    let read = |name: &str| -> Value { serde_json::from_str(&folder.read(name)).unwrap() };
    let found = read("out/case/table/simulation.json");
    assert_eq!(found["runs"].as_array().unwrap().len(), 3);
    let frames = found["t"].as_array().unwrap().len();
    assert_eq!(frames, 201);
    // A tilt of 1e-5 moves the whole by 2 cm in 20 s.
    let x = |figures: &Value| figures["final_x"].as_f64().unwrap();
    let moved = found["measured_figures"]["final_x"]["mean"]
        .as_f64()
        .unwrap()
        - x(&found["planned_figures"]);
    assert!((moved - 0.0196).abs() < 1e-3, "{moved}");
    let spread = &found["measured_figures"]["final_x"];
    let deviation = spread["deviation"].as_f64().unwrap();
    assert!(deviation > 1e-6 && deviation < 1e-3, "{spread}");
    let csv = folder.read("out/case/table/simulation.csv");
    assert!(
        csv.starts_with("run,t,planned_x,planned_y,planned_eta,measured_x,"),
        "{csv}"
    );
    assert!(
        csv.lines()
            .next()
            .unwrap()
            .ends_with(",th_1,th_2,tau_1,tau_2")
    );
    assert_eq!(csv.lines().count(), 1 + 3 * frames);

    // The same again is the same; another seed is not.
    simulate(&["--repeat", "3", "--out", "again"]);
    assert_eq!(read("again/simulation.json")["runs"], found["runs"]);
    simulate(&["--repeat", "3", "--seed", "6", "--out", "other"]);
    assert_ne!(read("other/simulation.json")["runs"][0], found["runs"][0]);
}

#[test]
fn a_start_of_another_robot_is_refused() {
    let folder = Folder::new(PROBLEM);
    assert_eq!(
        folder
            .run(&["plan", "case.toml", "--out", "a", "--quiet"])
            .code,
        0
    );
    let one_joint = PROBLEM
        .replace(
            "\"robot.toml\"",
            "{ file = \"robot.toml\", lock = { elbow = 0.3 } }",
        )
        .replace("[0.0, 0.0]", "[0.0]")
        .replace("[0.5, 1.0]", "[0.5]")
        .replace("[5.0, 4.0]", "5.0");
    folder.write("other.toml", &one_joint);
    let run = folder.run(&["plan", "other.toml", "--warm-start", "a/solution.json"]);
    assert_eq!(run.code, 2, "{run:?}");
    assert_eq!(run.stderr.lines().count(), 1);
    assert!(
        run.stderr.starts_with("a/solution.json: "),
        "{}",
        run.stderr
    );
}

/// Files of earlier versions call the multifrontal linear solver "ours".
#[test]
fn the_earlier_name_of_the_linear_solver_is_read() {
    let problem = format!("{PROBLEM}\n[solver]\nlinear_solver = \"ours\"\n");
    let folder = Folder::new(&problem);
    let plan = ["plan", "case.toml", "--out", "a", "--quiet"];
    assert_eq!(folder.run(&plan).code, 0);
    let mut saved: Value = serde_json::from_str(&folder.read("a/solution.json")).unwrap();
    let name = &mut saved["provenance"]["linear_solver"];
    assert_eq!(*name, "multifrontal");

    *name = "ours".into();
    folder.write("a/solution.json", &saved.to_string());
    for arguments in [
        &["verify", "a/solution.json", "--out", "b"][..],
        &["report", "a/solution.json"],
    ] {
        let run = folder.run(arguments);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    }
    assert!(folder.read("a/report.html").contains("multifrontal"));
}

/// Nothing of an earlier plan stands beside a new one.
#[test]
fn the_files_of_a_plan_are_one_set() {
    let folder = Folder::new(PROBLEM);
    let plan = ["plan", "case.toml", "--quiet", "--out", "a"];
    assert_eq!(folder.run(&plan).code, 0);
    let verify = ["verify", "a/solution.json", "--out", "a"];
    assert_eq!(folder.run(&verify).code, 0);
    assert!(folder.path().join("a/verification.json").exists());
    assert_eq!(folder.run(&plan).code, 0);
    let names = |folder: &Folder| {
        let entries = std::fs::read_dir(folder.path().join("a")).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    };
    let set = ["report.html", "solution.json", "trajectory.csv"];
    assert_eq!(names(&folder), set);

    // Where one cannot be written, none is.
    let old = folder.read("a/solution.json");
    std::fs::remove_file(folder.path().join("a/report.html")).unwrap();
    std::fs::create_dir(folder.path().join("a/report.html")).unwrap();
    let run = folder.run(&[&plan[..], &["--set", "task.duration=21"]].concat());
    assert_eq!(run.code, 1, "{run:?}");
    assert!(
        run.stderr.starts_with("a/report.html: cannot be written: "),
        "{run:?}"
    );
    assert_eq!(folder.read("a/solution.json"), old);
    assert_eq!(names(&folder), set);
}

#[test]
fn files_of_a_platform_and_of_measurements_are_told_apart() {
    let folder = Folder::new(PROBLEM);
    folder.run(&["plan", "case.toml", "--out", "a", "--quiet", "--no-report"]);
    let platforms = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("config/platforms");
    let path = |name: &str| platforms.join(name).display().to_string();
    let (table, measured) = (path("air-bearing.toml"), path("published.toml"));
    let run = folder.run(&["simulate", "a/solution.json", &measured]);
    assert_eq!(run.code, 2, "{run:?}");
    let said = "experiments: measurements; expected the platform alone; measurements are for simulate --fit";
    assert!(run.stderr.contains(said), "{}", run.stderr);
    let run = folder.run(&["simulate", "--fit", &table]);
    assert_eq!(run.code, 2, "{run:?}");
    let said = "simulate SOLUTION.json takes this file";
    assert!(run.stderr.contains(said), "{}", run.stderr);
}
