//! `init` and `completions`.

use crate::program::{Folder, PROBLEM};
use serde_json::Value;
use std::collections::BTreeSet;

#[test]
fn what_init_writes_is_planned_and_spares_the_base() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["init", "my/arm"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    assert!(run.stdout.contains("plan my/arm/problem.toml"), "{run:?}");
    let run = folder.run(&["check", "my/arm/problem.toml"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    let line = "straight-line base motion: (15.45299, -6.11540, -8.88091)°";
    assert!(run.stdout.contains(line), "{}", run.stdout);
    // Progress is for slow machines.
    let run = folder.run(&["plan", "my/arm/problem.toml", "--out", "o", "--quiet"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    let solution: Value = serde_json::from_str(&folder.read("o/solution.json")).unwrap();
    let turned = solution["metrics"]["final_base_attitude"].as_f64().unwrap();
    assert!(turned.to_degrees() < 1.5, "{}", turned.to_degrees());
}

#[test]
fn choices_of_the_starter_can_be_made() {
    let folder = Folder::new(PROBLEM);
    folder.run(&["init", "s"]);
    let text = folder.read("s/problem.toml");
    // Each key that is commented out, taken in alone, with all lines about it.
    let key = |line: &str| Some(line.strip_prefix("# ")?.split_once(" = ")?.0.to_owned());
    let keys: BTreeSet<String> = text.lines().filter_map(key).collect();
    assert!(keys.len() > 5, "{keys:?}");
    for chosen in keys {
        // A goal for the end effector is a table, taken in as a whole.
        if ["frame", "position", "orientation"].contains(&chosen.as_str()) {
            continue;
        }
        let lines = text.lines().filter_map(|line| {
            if key(line).as_ref() == Some(&chosen) {
                return Some(&line[2..]);
            }
            (!line.starts_with(&format!("{chosen} = "))).then_some(line)
        });
        let lines: Vec<&str> = lines.collect();
        folder.write("s/problem.toml", &lines.join("\n"));
        let run = folder.run(&["check", "s/problem.toml"]);
        assert_eq!(run.code, 0, "{chosen}: {run:?}");
    }
}

#[test]
fn the_goal_of_the_starter_can_be_the_tool_s() {
    let folder = Folder::new(PROBLEM);
    folder.run(&["init", "s"]);
    let text = folder.read("s/problem.toml");
    let table = [
        "[task.final.end_effector]",
        "frame",
        "position",
        "orientation",
    ];
    let lines = text.lines().filter_map(|line| {
        let choice = line
            .strip_prefix("# ")
            .filter(|line| table.iter().any(|begin| line.starts_with(begin)));
        choice.or((!line.starts_with("final.joints")).then_some(line))
    });
    let lines: Vec<&str> = lines.collect();
    folder.write("s/problem.toml", &lines.join("\n"));
    let run = folder.run(&["plan", "s/problem.toml", "--out", "o", "--quiet"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
}

#[test]
fn init_leaves_what_is_there() {
    let folder = Folder::new(PROBLEM);
    folder.write("arm.urdf", "mine");
    let before = folder.names();
    let run = folder.run(&["init"]);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{run:?}");
    assert_eq!(
        run.stderr,
        "./arm.urdf: is there already and stays as it is; expected a folder without it\n"
    );
    assert_eq!(
        (folder.names(), folder.read("arm.urdf")),
        (before, "mine".into())
    );
    let run = folder.run(&["init", "case.toml/x"]);
    assert_eq!(run.code, 2, "{run:?}");
    assert!(run.stderr.contains("expected a folder that can"), "{run:?}");
}

#[test]
fn shells_are_told_every_command() {
    let folder = Folder::new(PROBLEM);
    for shell in ["bash", "zsh", "fish"] {
        let run = folder.run(&["completions", shell]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{shell}");
        for word in ["plan", "report", "init", "warm-start"] {
            assert!(run.stdout.contains(word), "{shell}: {word}");
        }
    }
    assert_eq!(folder.run(&["completions", "none"]).code, 2);
}
