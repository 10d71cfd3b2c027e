//! Way-points.

use crate::complaints::*;
use crate::program::{Folder, PROBLEM, edited};

/// The complaint about the problem with these `[[task.way_points]]`.
#[track_caller]
fn way_points(points: &[&str], duration: &str) -> String {
    let points: String = points
        .iter()
        .map(|point| format!("[[task.way_points]]\n{point}\n\n"))
        .collect();
    let text = edited(PROBLEM, "[limits]\n", &format!("{points}[limits]\n"));
    let text = edited(&text, "duration = 20.0", duration);
    complaint(&Folder::new(&text), &[])
}

#[test]
fn way_points_that_cannot_be() {
    const FIXED: &str = "duration = 20.0";
    let joints = "joints = [0.1, 0.2]";
    for (points, expected) in [
        (
            vec![format!("time = 20.0\n{joints}")],
            "case.toml:11: task.way_points[0].time: 20 s; expected a time above 0 and below the \
             duration, 20 s",
        ),
        (
            vec![format!("time = -1.0\n{joints}")],
            "case.toml:11: task.way_points[0].time: -1 s; expected a time above 0 and below the \
             duration, 20 s",
        ),
        (
            vec![format!("fraction = 1.5\n{joints}")],
            "case.toml:11: task.way_points[0].fraction: 1.5; expected a fraction of the duration, \
             above 0 and below 1",
        ),
        (
            vec![
                format!("time = 5.0\n{joints}"),
                format!("fraction = 0.25\n{joints}"),
            ],
            "case.toml:15: task.way_points[1].fraction: 0.25; expected way-points in the order of \
             time, no two at one time",
        ),
        (
            vec![
                format!("time = 5.0\n{joints}"),
                format!("time = 4.0\n{joints}"),
            ],
            "case.toml:15: task.way_points[1].time: 4 s; expected way-points in the order of \
             time, no two at one time",
        ),
        (
            vec![format!("time = 5.0\nfraction = 0.25\n{joints}")],
            "case.toml:12: task.way_points[0].fraction: time as well; expected either time, s, or \
             fraction",
        ),
        (
            vec![joints.into()],
            "case.toml:10: task.way_points[0].time: missing; expected a time, s, or fraction, \
             that of the duration",
        ),
        (
            vec!["time = 5.0".into()],
            "case.toml:10: task.way_points[0]: nothing to hold there; expected joints, \
             joint_rates, end_effector or several of them",
        ),
        (
            vec!["time = 5.0\njoints = { elbow = 1.6 }".into()],
            "case.toml:12: task.way_points[0].joints[1]: 1.6 for joint 'elbow'; expected a value \
             within limits.joint_position, [-1.5, 1.5]",
        ),
        (
            vec!["time = 5.0\njoint_rates = { shoulder = 1.0 }".into()],
            "case.toml:12: task.way_points[0].joint_rates[0]: 1 for joint 'shoulder'; expected a \
             value within limits.joint_velocity, [-0.9, 0.9]",
        ),
        (
            vec!["time = 5.0\njoints = [0.1]".into()],
            "case.toml:12: task.way_points[0].joints: 1 value; expected 2, one a joint: shoulder, \
             elbow",
        ),
        (
            vec!["time = 5.0\njoints = { elbo = 0.1 }".into()],
            "case.toml:12: task.way_points[0].joints.elbo: unknown key; did you mean 'elbow'?",
        ),
        (
            vec!["time = 5.0\nend_effector = { frame = \"base\" }".into()],
            "case.toml:12: task.way_points[0].end_effector: neither; expected a position, an \
             orientation or both",
        ),
    ] {
        let points: Vec<&str> = points.iter().map(String::as_str).collect();
        assert_eq!(way_points(&points, FIXED), expected);
    }
    assert_eq!(
        way_points(
            &["time = 5.0\njoints = [0.1, 0.2]"],
            "duration = { min = 5.0, max = 30.0 }"
        ),
        "case.toml:11: task.way_points[0].time: 5 s, where the duration is free; expected \
         fraction, the fraction of the duration"
    );
}
