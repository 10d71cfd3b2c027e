//! The commands: what they print, where, and how they end.

mod program;

use program::{Folder, PROBLEM};
use serde_json::Value;

#[test]
fn help_names_every_command() {
    let run = Folder::new(PROBLEM).run(&["--help"]);
    assert_eq!(run.code, 0);
    for command in [
        "plan",
        "check",
        "compare",
        "pareto",
        "table2",
        "figures",
        "reproduce",
        "verify",
        "simulate",
        "doctor",
    ] {
        assert!(
            run.stdout
                .lines()
                .any(|line| line.trim_start().starts_with(command)),
            "{command}"
        );
    }
}

#[test]
fn check_prints_what_was_understood() {
    let run = Folder::new(PROBLEM).run(&["check", "case.toml"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for expected in [
        "case.toml: valid",
        "planar",
        "3: base 15.2 kg, upper_arm 1.7 kg, forearm 1.2 kg",
        "18.1 kg",
        "±85.9437°",
        "shoulder ±5 rad/s², elbow ±4 rad/s²",
        "straight-line base motion: ",
    ] {
        assert!(
            run.stdout.contains(expected),
            "{expected} in\n{}",
            run.stdout
        );
    }
}

#[test]
fn straight_line_motion_of_the_published_case() {
    let folder =
        Folder::new(&PROBLEM.replace("[0.5, 1.0]", "[0.5235987755982988, 1.0471975511965976]"));
    let run = folder.run(&["check", "case.toml"]);
    let expected = "straight-line base motion: -36.64882°, (1.475023, 0.414488) cm\n";
    assert!(run.stdout.ends_with(expected), "{}", run.stdout);
}

#[test]
fn straight_line_motion_of_an_arm_in_space() {
    let folder = Folder::new(include_str!("data/chaser.toml"));
    folder.write("chaser-7dof.toml", include_str!("data/chaser-7dof.toml"));
    let run = folder.run(&["check", "case.toml"]);
    assert_eq!(run.code, 0, "{run:?}");
    assert!(run.stdout.contains("spatial"), "{}", run.stdout);
    let line = run.stdout.lines().last().unwrap();
    let numbers: Vec<f64> = line
        .split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'))
        .filter_map(|word| word.parse().ok())
        .collect();
    // As three other tools have it, degrees and centimetres.
    let expected = [-0.8869, 8.2104, 1.3218, -1.6188, 0.4726, -2.9121];
    assert_eq!(numbers.len(), expected.len(), "{line}");
    for (found, expected) in numbers.iter().zip(expected) {
        assert!((found - expected).abs() < 6e-5, "{line}");
    }
}

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
        assert_eq!(names, ["solution.json", "trajectory.csv"]);
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

#[test]
fn values_of_the_command_line_go_first() {
    let folder = Folder::new(PROBLEM);
    let arguments = [
        "plan",
        "case.toml",
        "--out",
        "o",
        "--json",
        "--quiet",
        "--method",
        "rpm",
        "--tolerance",
        "2e-2",
        "--set",
        "name=other",
        "--set",
        "task.final.joints={shoulder=0.25,elbow=0.5}",
    ];
    let run = folder.run(&arguments);
    assert_eq!(run.code, 0, "{run:?}");
    let document: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(document["name"], "other");
    assert_eq!(document["method"], "rpm");
    assert_eq!(document["segments"], 1);
    assert_eq!(document["tolerance"], 2e-2);
    let positions = document["trajectory"]["joint_position"].as_array().unwrap();
    let last = positions.last().unwrap();
    assert!((last[0].as_f64().unwrap() - 0.25).abs() < 1e-7);
    assert_eq!(
        document["provenance"]["problem"]["overrides"],
        serde_json::json!([
            "--set name=other",
            "--set task.final.joints={shoulder=0.25,elbow=0.5}",
            "--method rpm",
            "--tolerance 0.02"
        ])
    );
}

#[test]
fn limits_are_understood_in_every_form() {
    let folder = Folder::new(PROBLEM);
    for (form, expected) in [
        ("2.0", "±2 rad/s²"),
        ("[5, 4]", "shoulder ±5 rad/s², elbow ±4 rad/s²"),
        ("[4, 5]", "shoulder ±4 rad/s², elbow ±5 rad/s²"),
        ("[-1, 2]", "-1 rad/s² to 2 rad/s²"),
        ("[0, 2]", "0 rad/s² to 2 rad/s²"),
        (
            "[[-1, 2], 3]",
            "shoulder -1 rad/s² to 2 rad/s², elbow ±3 rad/s²",
        ),
        (
            "{ elbow = [-1, inf] }",
            "shoulder none, elbow from -1 rad/s²",
        ),
        ("inf", "none"),
    ] {
        folder.write("case.toml", &PROBLEM.replace("[5.0, 4.0]", form));
        let run = folder.run(&["check", "case.toml"]);
        assert_eq!(run.code, 0, "{run:?}");
        let line = run
            .stdout
            .lines()
            .find(|line| line.contains(" control "))
            .unwrap();
        let value = line.trim_start().trim_start_matches("control").trim();
        assert_eq!(value, expected, "{form}");
    }
}

#[test]
fn a_locked_joint_is_left_out() {
    let robot = "{ file = \"robot.toml\", lock = { elbow = 0.3 }, end_effector = \"forearm\" }";
    let problem = PROBLEM
        .replace("\"robot.toml\"", robot)
        .replace("[0.0, 0.0]", "[0.0]")
        .replace("[0.5, 1.0]", "{ shoulder = 0.5 }")
        .replace("[5.0, 4.0]", "5.0");
    let run = Folder::new(&problem).run(&["check", "case.toml"]);
    assert_eq!(run.code, 0, "{run:?}");
    assert!(
        run.stdout.contains("2: base 15.2 kg, upper_arm 2.9 kg"),
        "{}",
        run.stdout
    );
    assert!(run.stdout.contains("18.1 kg"));
}

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

#[test]
fn an_infeasible_problem_says_so_and_why() {
    let problem = format!("{PROBLEM}max_iterations = 2\n").replace(
        "control = [5.0, 4.0]",
        "control = [5.0, 4.0]\nfinal_base_attitude = 0.01",
    );
    let folder =
        Folder::new(&problem.replace("joint_position = 1.5", "joint_position = [0.0, 1.0]"));
    let run = folder.run(&["plan", "case.toml", "--out", "o"]);
    assert_eq!(run.code, 3, "{run:?}");
    assert!(
        run.stdout.contains("limits.final_base_attitude"),
        "{}",
        run.stdout
    );
    let solution: Value = serde_json::from_str(&folder.read("o/solution.json")).unwrap();
    assert_eq!(solution["status"], "infeasible");
    let limits = solution["diagnosis"]["limits"].as_array().unwrap();
    assert!(
        limits
            .iter()
            .any(|limit| limit["key"] == "limits.final_base_attitude")
    );
}

#[test]
fn a_tolerance_out_of_reach_is_not_convergence() {
    let folder = Folder::new(PROBLEM);
    let arguments = [
        "plan",
        "case.toml",
        "--out",
        "o",
        "--tolerance",
        "1e-12",
        "--set",
        "mesh.max_iterations=1",
        "--quiet",
    ];
    let run = folder.run(&arguments);
    assert_eq!(run.code, 4, "{run:?}");
    assert_eq!(run.stderr.lines().count(), 1);
    let solution: Value = serde_json::from_str(&folder.read("o/solution.json")).unwrap();
    assert_eq!(solution["status"], "not_converged");
    assert!(solution["points"].as_u64().unwrap() > 0);
}

#[test]
fn table2_sets_both_methods_beside_the_published_figures() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["table2", "--out", "o", "--repeat", "1"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    let markdown = folder.read("o/table2.md");
    assert!(run.stdout.starts_with(&markdown), "{}", run.stdout);
    let data: Value = serde_json::from_str(&folder.read("o/table2.json")).unwrap();
    let rows = data["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 12);
    let of =
        |line: &str| line.starts_with('|') && (line.contains("a-rpm") || line.contains(" rpm"));
    assert_eq!(markdown.lines().filter(|line| of(line)).count(), 12);
    for row in rows {
        let within = row["max_error"].as_f64().unwrap() <= row["tolerance"].as_f64().unwrap();
        assert_eq!(row["reached"], within, "{row}");
        assert!(row["published"]["points"].is_u64(), "{row}");
    }
    let smooth = rows.iter().filter(|row| row["problem"] == "table1-smooth");
    assert!(smooth.clone().count() == 6 && smooth.clone().all(|row| row["reached"] == true));
    // The same figures in all three.
    let csv = folder.read("o/table2.csv");
    let mut lines = csv.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let shown: Vec<&str> = markdown.lines().filter(|line| of(line)).collect();
    for ((line, row), shown) in lines.zip(rows).zip(shown) {
        for (name, cell) in header.iter().zip(line.split(',')) {
            let value = match name.strip_prefix("published_") {
                Some(name) => &row["published"][name],
                None => &row[*name],
            };
            match value {
                Value::Number(number) => {
                    assert_eq!(number.as_f64(), cell.parse().ok(), "{name}: {line}");
                }
                other => assert_eq!(other.to_string().trim_matches('"'), cell, "{name}"),
            }
        }
        let error = format!("{:.2e}", row["max_error"].as_f64().unwrap());
        let points = format!(" {} |", row["points"]);
        assert!(shown.contains(&error) && shown.contains(&points), "{shown}");
        let gap = row["objective"].as_f64().unwrap() - row["optimum"].as_f64().unwrap();
        assert_eq!(row["distance"].as_f64().unwrap(), gap.abs());
    }
    assert_eq!(csv.lines().count(), 13);
}

#[test]
fn figures_of_the_paper_are_drawn() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["figures", "--out", "o"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    for (name, panels) in [
        ("figure2-relaxed", 3),
        ("figure2-smooth", 3),
        ("figure2-bounded", 3),
        ("figure2-heavy-base", 3),
        ("figure3-relaxed", 6),
        ("figure3-smooth", 2),
        ("figure4", 6),
        ("figure4-bounded", 6),
        ("figure5", 6),
        ("figure6", 3),
        ("figure6-heavy-base", 3),
    ] {
        let svg = folder.read(&format!("o/{name}.svg"));
        let titles = svg.matches("font-size=\"8\"").count();
        assert_eq!(titles, panels, "{name}");
        let axis = match name {
            "figure3-relaxed" | "figure3-smooth" => "Boundaries of the segments (s)",
            _ if panels == 6 => "x (m)",
            _ => "Time (s)",
        };
        assert_eq!(svg.matches(axis).count(), panels, "{name}");
        let png = std::fs::read(folder.path().join(format!("o/{name}.png"))).unwrap();
        assert!(png.starts_with(b"\x89PNG"), "{name}");
        assert!(run.stdout.contains(&format!("o/{name}.png")), "{name}");
    }
}

#[test]
fn doctor_finds_a_linear_solver() {
    let folder = Folder::new(PROBLEM);
    folder.write("ipopt.opt", "no_such_option 3\n");
    let run = folder.run(&["doctor"]);
    assert_eq!(run.code, 0, "{run:?}");
    for expected in ["mumps", "Ipopt ", "in this folder, and ignored"] {
        assert!(run.stdout.contains(expected), "{}", run.stdout);
    }
}

#[test]
fn the_number_of_threads_is_chosen() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["doctor", "--threads", "3"]);
    assert_eq!(run.code, 0, "{run:?}");
    let mut words = run.stdout.split_whitespace().rev();
    assert_eq!([words.next(), words.next()], [Some("3"), Some("threads")]);
    let run = folder.run(&["plan", "case.toml", "--threads", "0"]);
    assert_eq!(run.code, 2, "{run:?}");
    assert!(run.stderr.contains("expected a number from 1"), "{run:?}");
}

/// Interrupts a command at work on a mesh that takes it long; its folder is returned, which then
/// holds what was written whole and nothing else.
#[cfg(unix)]
fn interrupted(command: &str, extra: &[&str]) -> Folder {
    use std::process::{Command, Stdio};
    use std::time::Duration;

    // A mesh large enough to be at work when the signal comes.
    let problem = PROBLEM
        .replace("segments = 4", "segments = 4000")
        .replace("tolerance = 1e-3", "tolerance = 1e-13");
    let folder = Folder::new(&problem);
    let mut child = Command::new(env!("CARGO_BIN_EXE_ffsm-ipopt"))
        .args([command, "case.toml", "--out", "o"])
        .args(extra)
        .current_dir(folder.path())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    // The folder is there once the handler is about to be.
    while !folder.path().join("o").exists() {
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(Duration::from_millis(300));
    // The shell's own: a bare Debian has no program of that name.
    let sent = Command::new("sh")
        .args(["-c", &format!("kill -INT {}", child.id())])
        .status()
        .unwrap();
    assert!(sent.success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    for entry in std::fs::read_dir(folder.path().join("o")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(!name.starts_with('.'), "left behind: {name}");
    }
    folder
}

/// Ctrl-C leaves the best trajectory, marked.
#[cfg(unix)]
#[test]
fn an_interrupted_plan_is_written_and_marked() {
    let folder = interrupted("plan", &["--quiet"]);
    let solution: Value = serde_json::from_str(&folder.read("o/solution.json")).unwrap();
    assert_eq!(solution["status"], "interrupted");
}

/// Ctrl-C leaves the plans made until then, the last of them marked.
#[cfg(unix)]
#[test]
fn an_interrupted_comparison_is_written_as_far_as_it_came() {
    let folder = interrupted("compare", &[]);
    let found: Value = serde_json::from_str(&folder.read("o/compare.json")).unwrap();
    let rows = found["rows"].as_array().unwrap();
    assert_eq!(rows.last().unwrap()["status"], "interrupted", "{rows:?}");
    for row in rows {
        let path = format!("o/{}/solution.json", row["method"].as_str().unwrap());
        let solution: Value = serde_json::from_str(&folder.read(&path)).unwrap();
        assert_eq!(solution["status"], row["status"]);
    }
    let table = folder.read("o/compare.md");
    assert!(table.contains("| interrupted |"), "{table}");
    assert_eq!(folder.read("o/compare.csv").lines().count(), 1 + rows.len());
    assert!(folder.path().join("o/compare.png").exists());
}

/// Ctrl-C leaves the points found until then, the last of them marked.
#[cfg(unix)]
#[test]
fn an_interrupted_trade_off_is_written_as_far_as_it_came() {
    let folder = interrupted("pareto", &[]);
    let found: Value = serde_json::from_str(&folder.read("o/pareto.json")).unwrap();
    let rows = found["rows"].as_array().unwrap();
    assert_eq!(rows.last().unwrap()["status"], "interrupted", "{rows:?}");
    assert_eq!(folder.read("o/pareto.csv").lines().count(), 1 + rows.len());
    assert!(folder.path().join("o/pareto.png").exists());
}

/// `PROBLEM` with a forearm off the plane, so that the robot moves in space.
fn folder_in_space(base: &str) -> Folder {
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
