//! The description of the base attitude.

use crate::complaints::*;
use crate::program::{Folder, PROBLEM, edited};

/// The complaint about a robot in space with lines of `[base]` and `[limits]` or `[cost]` added.
#[track_caller]
fn in_space(base: &str, table: &str, line: &str) -> String {
    let table = format!("[{table}]");
    let text = edited(
        PROBLEM,
        &table,
        &format!("[base]\n{base}\n\n{table}\n{line}"),
    );
    let folder = Folder::new(&text.replace("final_base_attitude = 1.0\n", ""));
    // A mass centre off the plane of the others.
    let robot = edited(ROBOT, "com = [0.35, 0.0, 0.0]", "com = [0.35, 0.0, 0.02]");
    folder.write("robot.toml", &robot);
    complaint(&folder, &[])
}

#[test]
fn unknown_description_of_the_attitude() {
    assert_eq!(
        in_space("attitude = \"quaternions\"", "limits", ""),
        "case.toml:11: base.attitude: \"quaternions\"; expected \"roll-pitch-yaw\", \"quaternion\" or \"mrp\" (did you mean 'quaternion'?)"
    );
    assert_eq!(
        in_space("attitude = \"euler\"", "limits", ""),
        "case.toml:11: base.attitude: \"euler\"; expected \"roll-pitch-yaw\", \"quaternion\" or \"mrp\""
    );
    assert_eq!(
        in_space("attitude = 4", "limits", ""),
        "case.toml:11: base.attitude: 4; expected \"roll-pitch-yaw\", \"quaternion\" or \"mrp\""
    );
}

#[test]
fn a_base_without_a_mass_has_to_say_something() {
    assert_eq!(
        in_space("", "limits", ""),
        "case.toml:10: base.mass: missing; expected a finite mass above zero, kg"
    );
    assert_eq!(
        in_space("attitude = \"mrp\"\ninertia = 3.0", "limits", ""),
        "case.toml:10: base.mass: missing; expected a finite mass above zero, kg"
    );
}

#[test]
fn a_rotation_angle_takes_one_number() {
    for by in ["quaternion", "mrp"] {
        let base = format!("attitude = \"{by}\"");
        for (table, line) in [
            ("limits", "base_attitude = [0.1, 0.2, 0.3]"),
            ("limits", "base_attitude = [-0.1, 0.2]"),
            ("limits", "final_base_attitude = { pitch = 0.2 }"),
            ("cost", "final_base_attitude = [1.0, 1.0, 0.0]"),
        ] {
            let complaint = in_space(&base, table, line);
            let key = format!("{table}.{}", line.split(' ').next().unwrap());
            assert!(complaint.contains(&key), "{complaint}");
            let expected = "; expected one number, for the rotation angle of the base: base.attitude has no roll, pitch or yaw";
            assert!(complaint.ends_with(expected), "{complaint}");
        }
        let complaint = in_space(&base, "limits", "base_rate = { roll = 0.1 }");
        assert!(
            complaint.contains("limits.base_rate.roll: unknown key"),
            "{complaint}"
        );
        let complaint = in_space(&base, "limits", "base_attitude = -0.1");
        assert!(
            complaint.contains("a bound of zero or above"),
            "{complaint}"
        );
    }
}
