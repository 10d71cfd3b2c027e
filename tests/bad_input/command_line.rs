//! The command line.

use crate::complaints::*;
use crate::program::{Folder, PROBLEM};

#[test]
fn assignments_that_set_nothing() {
    for (assignment, expected) in [
        ("mesh.points", "no '='; expected --set key.path=value"),
        (
            "=3",
            "a part of the key is empty; expected --set key.path=value",
        ),
        (
            "task.duration.min.x=3",
            "task.duration: 20.0; expected a table, so that a key in it can be set",
        ),
        (
            "mesh.point=3",
            "mesh.point: unknown key; did you mean 'points'?",
        ),
    ] {
        assert_eq!(set(assignment), expected);
    }
}

#[test]
fn bad_usage() {
    let folder = Folder::new(PROBLEM);
    for arguments in [
        &["plan"][..],
        &["nonsense"],
        &["plan", "case.toml", "--method", "x"],
        &["table2", "--repeat", "0"],
    ] {
        let run = folder.run(arguments);
        assert_eq!(run.code, 2, "{run:?}");
        assert_eq!(run.stdout, "");
    }
    assert_eq!(folder.names(), ["case.toml", "robot.toml"]);
}
