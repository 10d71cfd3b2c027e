//! Files and folders.

use crate::complaints::*;
use crate::program::{Folder, PROBLEM};

#[test]
fn missing_problem_file() {
    let run = Folder::new(PROBLEM).run(&["plan", "none.toml"]);
    assert_eq!(run.code, 2);
    assert_eq!(
        run.stderr,
        "none.toml: cannot be read: No such file or directory (os error 2); expected a problem file\n"
    );
}

#[test]
fn problem_file_that_is_no_text() {
    let folder = Folder::new(PROBLEM);
    std::fs::write(folder.path().join("case.toml"), [0xff, 0xfe, 0x00]).unwrap();
    assert_eq!(
        complaint(&folder, &[]),
        "case.toml: cannot be read: it is not UTF-8 text; expected a problem file"
    );
}

#[test]
fn missing_robot_file() {
    assert_eq!(
        problem("\"robot.toml\"", "\"arm.toml\""),
        "case.toml:3: robot: arm.toml: cannot be read: No such file or directory (os error 2); \
         expected a robot file, by a path relative to the problem file"
    );
}

#[test]
fn toml_syntax() {
    let found = problem("duration = 20.0", "duration = = 20.0");
    assert!(found.starts_with("case.toml:6: not TOML: "), "{found}");
}

#[test]
fn key_given_twice() {
    let found = problem("duration = 20.0", "duration = 20.0\nduration = 21.0");
    assert_eq!(found, "case.toml:7: not TOML: duplicate key");
}

#[test]
fn folder_that_cannot_be_written() {
    let folder = Folder::new(PROBLEM);
    folder.write("blocked", "a file");
    assert_eq!(
        complaint(&folder, &["--out", "blocked/out"]),
        "blocked/out: the output folder cannot be written: Not a directory (os error 20); \
         expected a folder that can, see --out"
    );
}

#[test]
fn warm_start_that_is_no_solution() {
    let folder = Folder::new(PROBLEM);
    assert_eq!(
        complaint(&folder, &["--warm-start", "none.json"]),
        "none.json: cannot be read: No such file or directory (os error 2); expected a solution.json"
    );
    folder.write("solution.json", "{ \"schema\": 1, \"name\": 3 }");
    let found = complaint(&folder, &["--warm-start", "solution.json"]);
    assert!(
        found.starts_with("solution.json: name: invalid type: integer `3`"),
        "{found}"
    );
    assert!(
        found.ends_with("expected a solution.json of schema 1"),
        "{found}"
    );
}
