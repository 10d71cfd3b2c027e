//! What goes wrong with one row goes wrong with that row alone.

use crate::program::{PROBLEM, edited};
use crate::rows::*;
use ffsm_ipopt::config::ConfigError;
use ffsm_ipopt::nlp::Control;
use ffsm_ipopt::study::batch::{Engine, Event, Isolation, RowStatus, Task, Tasks, WorkerCommand};
use std::num::NonZero;
use std::process::Command;

/// Runs `batch` with faults in workers, at these positions.
fn with_faults(folder: &crate::program::Folder, faults: &str, arguments: &[&str]) {
    let output = Command::new(env!("CARGO_BIN_EXE_ffsm-ipopt"))
        .args([
            "batch",
            "batch.toml",
            "--out",
            "o",
            "--quiet",
            "--isolate",
            "--jobs",
            "2",
        ])
        .args(arguments)
        .env("FFSM_BATCH_FAULTS", faults)
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
}

#[test]
fn a_crash_a_hang_an_infeasible_and_a_malformed_problem_are_rows() {
    // Row 4 asks for a base that does not turn at all; row 5 for no time.
    let folder = folder(
        r#"schema = 1
problem = "case.toml"
[[vary]]
key = "limits.final_base_attitude"
table = "t.csv"
column = "final"
[[vary]]
key = "task.duration"
table = "t.csv"
column = "duration"
"#,
    );
    folder.write(
        "t.csv",
        "final,duration\n1,20\n1,21\n1,22\n1,23\n1e-4,20\n1,-1\n1,25\n1,0.1\n",
    );
    let limit = ["--time-limit", "8", "--memory", "600"];
    with_faults(&folder, "crash:1,hang:2,memory:3", &limit);
    let found = rows(&folder, "o");
    let of = |name: &str| {
        found
            .values()
            .map(|row| row[name].clone())
            .collect::<Vec<_>>()
    };
    let expected = [
        "solved",
        "crashed",
        "timed_out",
        "out_of_memory",
        "infeasible",
        "malformed",
        "solved",
        "impossible",
    ];
    assert_eq!(of("status"), expected);
    let reasons = of("reason");
    assert_eq!(reasons[1], "its process died of signal 6");
    assert_eq!(
        reasons[2],
        "it went on past the time limit and its process was ended"
    );
    assert!(
        reasons[3].starts_with("its process took "),
        "{}",
        reasons[3]
    );
    assert!(
        reasons[4].contains("limits.final_base_attitude"),
        "{}",
        reasons[4]
    );
    let begins = "row 5: batch.toml:8: task.duration: -1; expected a finite duration above zero";
    assert!(reasons[5].starts_with(begins), "{}", reasons[5]);
    assert!(
        reasons[7].contains("task.duration: 0.1 s"),
        "{}",
        reasons[7]
    );
    // What a row has is said where there is a problem, and nowhere else.
    assert_eq!(found[&7]["task.duration"], "0.1");
    assert_eq!(found[&5]["task.duration"], "");

    // Without their faults they are planned again, and none is there twice.
    let retry = "crashed,timed_out,out_of_memory";
    plan(
        &folder,
        "o",
        &["--isolate", "--retry", retry, "--time-limit", "60"],
    );
    let again = rows(&folder, "o");
    for position in [1, 2, 3] {
        assert_eq!(again[&position]["status"], "solved");
    }
    assert_eq!(again.len(), 8);
    for position in [0, 4, 5, 6, 7] {
        assert_eq!(again[&position], found[&position]);
    }
}

/// A plan that takes longer than it may ends by itself where the solver is asked.
#[test]
fn a_time_limit_ends_a_plan_in_a_thread() {
    let folder = folder(&edited(BATCH, "count = 12", "count = 2"));
    let slow = PROBLEM.replace("segments = 4", "segments = 3000");
    folder.write(
        "case.toml",
        &slow.replace("tolerance = 1e-3", "tolerance = 1e-13"),
    );
    plan(&folder, "o", &["--time-limit", "0.3"]);
    for row in rows(&folder, "o").values() {
        assert_eq!(row["status"], "timed_out", "{row:?}");
    }
}

/// MUMPS serves one thread of a process.
#[test]
fn plans_with_mumps_are_made_in_processes() {
    let folder = folder(&edited(BATCH, "count = 12", "count = 6"));
    folder.write(
        "case.toml",
        &format!("{PROBLEM}\n[solver]\nlinear_solver = \"mumps\"\n"),
    );
    let run = folder.run(&["batch", "batch.toml", "--out", "o", "--jobs", "2"]);
    assert_eq!(run.code, 0, "{run:?}");
    assert!(
        run.stderr.contains("in processes of their own"),
        "{}",
        run.stderr
    );
    let found = rows(&folder, "o");
    let of = |name: &str| {
        found
            .values()
            .map(|row| row[name].clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(of("status"), ["solved"; 6]);
    assert_eq!(of("linear_solver"), ["mumps"; 6]);
}

/// Problems one of which the program itself has a fault with.
struct Faulty;

impl Tasks for Faulty {
    fn count(&self) -> u64 {
        3
    }

    fn key(&self, position: u64) -> String {
        position.to_string()
    }

    fn task(&self, position: u64) -> Result<Task, ffsm_ipopt::study::batch::Refusal> {
        assert_ne!(position, 1, "as planned");
        let shipped: Result<_, ConfigError> =
            ffsm_ipopt::config::ProblemFile::shipped("table1-smooth");
        Ok(Task {
            problem: shipped.unwrap().problem,
            cells: Vec::new(),
        })
    }
}

#[test]
fn a_panic_is_a_row() {
    let mut ended = Vec::new();
    let mut engine = Engine::default();
    engine.jobs = NonZero::new(2).unwrap();
    let told = &mut |event| {
        if let Event::Record(record) = event {
            ended.push((record.position, record.status, record.reason));
        }
        Control::Continue
    };
    engine.run(&Faulty, 0..3, told).unwrap();
    ended.sort();
    let statuses: Vec<RowStatus> = ended.iter().map(|(_, status, _)| *status).collect();
    assert_eq!(
        statuses,
        [RowStatus::Solved, RowStatus::Panicked, RowStatus::Solved]
    );
    assert!(ended[1].2.contains("as planned"), "{}", ended[1].2);
}

#[test]
fn a_worker_that_cannot_begin_ends_the_batch() {
    for (program, expected) in [
        ("/no/such/program", "cannot be started"),
        ("/bin/false", "ended at once"),
    ] {
        let mut engine = Engine::default();
        engine.isolation = Isolation::Processes(WorkerCommand::new(program.into(), Vec::new()));
        let error = engine
            .run(&Faulty, 0..3, &mut |_| Control::Continue)
            .unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
    }
}
