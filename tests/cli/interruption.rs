//! Ctrl-C, and other signals that end a program.

use crate::program::{Folder, PROBLEM};
use serde_json::Value;

/// Interrupts a command at work on a mesh that takes it long; its folder is returned, which then
/// holds what was written whole and nothing else.
#[cfg(unix)]
fn interrupted(command: &str, extra: &[&str]) -> Folder {
    signalled("INT", command, extra)
}

/// The same by any signal.
#[cfg(unix)]
fn signalled(signal: &str, command: &str, extra: &[&str]) -> Folder {
    use std::process::{Command, Stdio};
    use std::time::Duration;

    // A mesh so large and tolerances so small that it is at work when the signal comes, however long
    // that takes on a machine with other work.
    let problem = PROBLEM
        .replace("segments = 4", "segments = 4000")
        .replace("tolerance = 1e-3", "tolerance = 1e-16");
    let problem = format!("{problem}\n[solver]\ntolerance = 1e-16\n");
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
        .args(["-c", &format!("kill -{signal} {}", child.id())])
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

/// Whether this process, and so what it starts, ignores SIGHUP.
#[cfg(unix)]
fn hangup_is_ignored() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    ignored.is_some_and(|mask| mask & 1 == 1)
}

/// So does what ends a program from outside, and a terminal that is closed.
#[cfg(unix)]
#[test]
fn a_plan_that_is_terminated_is_written_and_marked() {
    let signals = ["TERM", "HUP"];
    // Under nohup a closed terminal ends nothing.
    let count = if hangup_is_ignored() { 1 } else { 2 };
    for signal in &signals[..count] {
        let folder = signalled(signal, "plan", &["--quiet"]);
        let solution: Value = serde_json::from_str(&folder.read("o/solution.json")).unwrap();
        assert_eq!(solution["status"], "interrupted", "{signal}");
    }
}

/// Killed at any moment, a plan leaves no temporary file and no mixture with an earlier plan.
#[cfg(unix)]
#[test]
fn a_plan_that_is_killed_leaves_no_mixture() {
    use std::process::{Command, Stdio};
    use std::time::Duration;

    let folder = Folder::new(PROBLEM);
    let first = ["plan", "case.toml", "--quiet", "--out", "o"];
    assert_eq!(folder.run(&first).code, 0);
    let old = folder.read("o/trajectory.csv");
    for milliseconds in [30, 60, 90, 120, 150, 200, 250, 300, 400] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_ffsm-ipopt"))
            .args(first)
            .args(["--set", "task.duration=21"])
            .current_dir(folder.path())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(milliseconds));
        let _ = child.kill();
        child.wait().unwrap();
        for entry in std::fs::read_dir(folder.path().join("o")).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            assert!(!name.starts_with('.'), "left behind: {name}");
        }
        let csv = std::fs::read_to_string(folder.path().join("o/trajectory.csv"));
        let solution: Value = serde_json::from_str(&folder.read("o/solution.json")).unwrap();
        let new = solution["trajectory"]["t"]
            .as_array()
            .unwrap()
            .last()
            .unwrap()
            == 21.0;
        if let Ok(csv) = csv {
            assert_eq!(csv == old, !new);
        }
    }
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
