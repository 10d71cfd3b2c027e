//! Help, the machine, how many threads.

use crate::program::{Folder, PROBLEM};

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
        "disperse",
        "report",
        "sample",
        "export",
        "batch",
        "simulate",
        "doctor",
        "init",
        "schema",
        "completions",
        "man",
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
fn a_part_of_the_reproduction_does_not_search() {
    let run = Folder::new(PROBLEM).run(&["reproduce", "bounds", "--search", "4"]);
    assert_eq!(run.code, 2);
    assert!(
        run.stderr
            .contains("--search is for all of the reproduction")
    );
}

#[test]
fn the_manual_has_a_page_a_command() {
    let folder = Folder::new(PROBLEM);
    let run = folder.run(&["man", "pages"]);
    assert_eq!(run.code, 0, "{run:?}");
    for (page, said) in [
        ("ffsm-ipopt.1", "ffsm\\-ipopt\\-plan(1)"),
        ("ffsm-ipopt-plan.1", "\\-\\-tolerance"),
        ("ffsm-ipopt-export.1", "joint\\-trajectory"),
    ] {
        let text = folder.read(&format!("pages/{page}"));
        assert!(
            text.contains(".SH") && text.contains(said),
            "{page}: {text}"
        );
    }
    // Not of commands that are the program's own business.
    assert!(
        !folder
            .path()
            .join("pages/ffsm-ipopt-batch-worker.1")
            .exists()
    );
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

/// A library that has none of the linear solvers it is loaded for ended the process at the first call.
#[test]
fn a_library_without_its_linear_solvers_ends_nothing() {
    use std::process::Command;

    let folder = Folder::new(PROBLEM);
    let library = folder.path().join("libhsl.so");
    folder.write("empty.c", "int nothing(void) { return 0; }\n");
    let made = Command::new("cc")
        .args(["-shared", "-fPIC", "-o"])
        .arg(&library)
        .arg(folder.path().join("empty.c"))
        .status()
        .unwrap();
    assert!(made.success());
    // Before those that are there, which Ipopt itself may be among.
    let mut libraries = folder.path().as_os_str().to_owned();
    if let Some(others) = std::env::var_os("LD_LIBRARY_PATH") {
        libraries.push(":");
        libraries.push(others);
    }
    let run = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_ffsm-ipopt"))
            .args(arguments)
            .current_dir(folder.path())
            .env("LD_LIBRARY_PATH", &libraries)
            .output()
            .unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (
            output.status.code(),
            text(output.stdout),
            text(output.stderr),
        )
    };
    let (code, printed, _) = run(&["doctor"]);
    assert_eq!(code, Some(0), "{printed}");
    assert!(
        printed.contains("linear solvers      multifrontal, mumps"),
        "{printed}"
    );
    for name in ["ma27", "ma57", "ma77", "ma86", "ma97"] {
        let set = format!("solver.linear_solver={name}");
        let (code, _, complaint) = run(&["plan", "case.toml", "--set", &set]);
        assert_eq!(code, Some(2), "{name}: {complaint}");
        assert!(complaint.contains("solver.linear_solver: "), "{complaint}");
    }
}
