//! Tasks that no motion can carry out.

use crate::complaints::*;
use crate::program::{Folder, PROBLEM, edited};

#[test]
fn too_little_time() {
    assert_eq!(
        problem("duration = 20.0", "duration = 1.1"),
        "case.toml:6: task.duration: 1.1 s from the start to the goal, too short for joint \
         'elbow' to go 1 rad within limits.control and limits.joint_velocity, 0.9 rad/s; expected \
         at least 1.13361 s"
    );
    let slow = ["--set", "limits.joint_velocity=0.02"];
    let slow = complaint(&Folder::new(PROBLEM), &slow);
    assert!(
        slow.starts_with("case.toml: 2 faults: (1) case.toml:6: task.duration: 20 s"),
        "{slow}"
    );
}

#[test]
fn check_says_the_same() {
    let folder = Folder::new(&edited(PROBLEM, "duration = 20.0", "duration = 1.0"));
    let complaint = complaint(&folder, &[]);
    let check = folder.run(&["check", "case.toml"]);
    assert_eq!(check.code, 2, "{check:?}");
    assert_eq!(check.stderr.trim_end(), complaint);
}

#[test]
fn every_place_outside_of_its_limits_is_named_at_once() {
    let complaint = problem(
        "initial.joints = [0.0, 0.0]",
        "initial.joints = [2.0, -2.0]",
    );
    assert!(
        complaint.starts_with("case.toml: 2 faults: (1) case.toml:7: task.initial.joints[0]"),
        "{complaint}"
    );
}
