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
        "report",
        "simulate",
        "doctor",
        "init",
        "schema",
        "completions",
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
