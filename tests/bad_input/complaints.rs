//! What the program says of one wrong thing.

use crate::program::{Folder, PROBLEM, edited};

pub const ROBOT: &str = include_str!("../../config/robots/planar-2link.toml");

/// Runs `plan` with more arguments; the one line of its complaint.
#[track_caller]
pub fn complaint(folder: &Folder, arguments: &[&str]) -> String {
    let before = folder.names();
    let run = folder.run(&[&["plan", "case.toml"], arguments].concat());
    assert_eq!(run.code, 2, "{run:?}");
    assert_eq!(run.stdout, "", "nothing on standard output");
    assert_eq!(run.stderr.lines().count(), 1, "one line: {}", run.stderr);
    assert_eq!(folder.names(), before, "nothing written");
    run.stderr.trim_end().to_owned()
}

/// The complaint about the problem with `old` replaced by `new`.
#[track_caller]
pub fn problem(old: &str, new: &str) -> String {
    complaint(&Folder::new(&edited(PROBLEM, old, new)), &[])
}

/// The complaint about the robot with `old` replaced by `new`.
#[track_caller]
pub fn robot(old: &str, new: &str) -> String {
    let folder = Folder::new(PROBLEM);
    folder.write("robot.toml", &edited(ROBOT, old, new));
    complaint(&folder, &[])
}

/// The complaint about a value given by `--set`.
#[track_caller]
pub fn set(assignment: &str) -> String {
    let complaint = complaint(&Folder::new(PROBLEM), &["--set", assignment]);
    let prefix = format!("--set {assignment}: ");
    assert!(complaint.starts_with(&prefix), "{complaint}");
    complaint[prefix.len()..].to_owned()
}
