//! Limits, start and goal.

use crate::complaints::*;
use crate::program::{Folder, PROBLEM};

#[test]
fn limit_the_wrong_way_round() {
    for (assignment, expected) in [
        (
            "limits.joint_velocity=[0.9, -0.9]",
            "limits.joint_velocity: [0.9, -0.9]; expected [lo, hi] with lo not above hi, or bounds above zero",
        ),
        (
            "limits.control=[[1.0, -1.0], 2.0]",
            "limits.control[0]: [1.0, -1.0]; expected [lo, hi] with lo not above hi, or bounds above zero",
        ),
        (
            "limits.joint_position=-1.5",
            "limits.joint_position: -1.5; expected a bound of zero or above (inf for none), or [lo, hi]",
        ),
        (
            "limits.base_attitude=[0.2, 0.1]",
            "limits.base_attitude: [0.2, 0.1]; expected [lo, hi] with lo not above hi, or bounds above zero",
        ),
    ] {
        assert_eq!(set(assignment), expected);
    }
}

#[test]
fn limit_that_may_be_read_two_ways() {
    assert_eq!(
        set("limits.joint_position=[0.5, 1.5]"),
        "limits.joint_position: [0.5, 1.5] may be read two ways; expected [[0.5, 1.5], [0.5, 1.5]] \
         for one range or [[-0.5, 0.5], [-1.5, 1.5]] for a bound each"
    );
}

#[test]
fn start_and_goal_outside_their_limits() {
    assert_eq!(
        problem("[0.0, 0.0]", "[0.0, -2.0]"),
        "case.toml:7: task.initial.joints[1]: -2 rad for joint 'elbow'; expected a value within \
         limits.joint_position, [-1.5, 1.5]"
    );
    assert_eq!(
        problem("[0.5, 1.0]", "[1.6, 1.0]"),
        "case.toml:8: task.final.joints[0]: 1.6 rad for joint 'shoulder'; expected a value within \
         limits.joint_position, [-1.5, 1.5]"
    );
    assert_eq!(
        set("limits.base_attitude=[0.1, 0.2]"),
        "limits.base_attitude: [0.1, 0.2]; expected a range around 0, the attitude at the start"
    );
}

#[test]
fn wrong_number_of_joints() {
    assert_eq!(
        problem("[0.5, 1.0]", "[0.5, 1.0, 0.0]"),
        "case.toml:8: task.final.joints: 3 values; expected 2, one a joint: shoulder, elbow"
    );
    assert_eq!(
        problem("[0.5, 1.0]", "{ shoulder = 0.5 }"),
        "case.toml:8: task.final.joints.elbow: missing; expected a finite number"
    );
    assert_eq!(
        problem("[0.5, 1.0]", "{ shoulder = 0.5, elbwo = 1.0 }"),
        "case.toml:8: task.final.joints.elbwo: unknown key; did you mean 'elbow'?"
    );
    assert_eq!(
        problem("[5.0, 4.0]", "[5.0, 4.0, 3.0]"),
        "case.toml:13: limits.control: 3 values; expected 2, one a joint: shoulder, elbow"
    );
}

#[test]
fn rate_matrix_of_the_wrong_size() {
    assert_eq!(
        set("cost.rate_matrix=[[1, 0], [0, 1]]"),
        "cost.rate_matrix: 2 values; expected 3, the number of rows, one a base angle and joint"
    );
}

#[test]
fn options_that_ipopt_refuses() {
    let folder = Folder::new(&format!(
        "{PROBLEM}\n[solver]\noptions = {{ no_such_option = 3 }}\n"
    ));
    let run = folder.run(&["plan", "case.toml"]);
    assert_eq!(run.code, 2, "{run:?}");
    assert_eq!(
        run.stderr,
        "case.toml:26: solver.options.no_such_option: 3; expected an option and value that this Ipopt knows\n"
    );
}
