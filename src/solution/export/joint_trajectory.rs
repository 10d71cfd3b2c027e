//! Messages of ROS 2 as YAML, as `ros2 topic pub` and `ros2 action send_goal` take them.

use super::Samples;
use std::fmt::Write;

/// Nanoseconds a second.
const NANOSECONDS: f64 = 1e9;

/// A `trajectory_msgs/msg/JointTrajectory`: positions, velocities and accelerations of all joints, and
/// their efforts if `has_effort`: `joint_trajectory_controller` refuses a trajectory with efforts unless it
/// commands these. Times begin at 0; instants within a nanosecond are one.
pub fn joint_trajectory(samples: &Samples, has_effort: bool) -> String {
    let mut text = String::from("# trajectory_msgs/msg/JointTrajectory\n");
    message((samples, has_effort), "", &mut text);
    text
}

/// A goal of `control_msgs/action/FollowJointTrajectory`, with the tolerances that the controller is
/// configured with; `has_effort` as of [`joint_trajectory`].
pub fn follow_joint_trajectory(samples: &Samples, has_effort: bool) -> String {
    let mut text =
        String::from("# control_msgs/action/FollowJointTrajectory, the goal\ntrajectory:\n");
    message((samples, has_effort), "  ", &mut text);
    text.push_str(
        "path_tolerance: []\ngoal_tolerance: []\ngoal_time_tolerance: {sec: 0, nanosec: 0}\n",
    );
    text
}

fn message((samples, has_effort): (&Samples, bool), indent: &str, text: &mut String) {
    let names: Vec<String> = samples.joints.iter().map(|name| quoted(name)).collect();
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "{indent}header: {{stamp: {{sec: 0, nanosec: 0}}, frame_id: ''}}\n\
         {indent}joint_names: [{}]\n{indent}points:",
        names.join(", ")
    );
    let begin = samples.t.first().copied().unwrap_or(0.0);
    let mut last = None;
    for (k, t) in samples.t.iter().enumerate() {
        let nanoseconds = ((t - begin) * NANOSECONDS).round() as u64;
        if last == Some(nanoseconds) {
            continue;
        }
        last = Some(nanoseconds);
        let effort = match has_effort {
            true => list(&samples.joint_torque[k]),
            false => "[]".into(),
        };
        let _ = writeln!(
            text,
            "{indent}- positions: {}\n{indent}  velocities: {}\n{indent}  accelerations: {}\n\
             {indent}  effort: {effort}\n{indent}  time_from_start: {{sec: {}, nanosec: {}}}",
            list(&samples.joint_position[k]),
            list(&samples.joint_velocity[k]),
            list(&samples.joint_acceleration[k]),
            nanoseconds / 1_000_000_000,
            nanoseconds % 1_000_000_000
        );
    }
}

fn list(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|value| number(*value)).collect();
    format!("[{}]", values.join(", "))
}

/// A number that every reader of YAML takes for one: those of YAML 1.1 ask for a point and for the sign of
/// the exponent.
fn number(value: f64) -> String {
    let text = format!("{value:?}");
    let Some((digits, exponent)) = text.split_once('e') else {
        return text;
    };
    let point = if digits.contains('.') { "" } else { ".0" };
    let sign = if exponent.starts_with('-') { "" } else { "+" };
    format!("{digits}{point}e{sign}{exponent}")
}

/// A name between quotation marks, whatever is in it: strings of JSON are strings of YAML.
fn quoted(name: &str) -> String {
    serde_json::Value::from(name).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_numbers_to_every_reader() {
        assert_eq!(number(0.5), "0.5");
        assert_eq!(number(-0.0), "-0.0");
        assert_eq!(number(1e-9), "1.0e-9");
        assert_eq!(number(2.5e20), "2.5e+20");
        assert_eq!(number(1e300), "1.0e+300");
    }

    #[test]
    fn names_cannot_break_out() {
        assert_eq!(quoted("a: [\"b\"]\nc"), r#""a: [\"b\"]\nc""#);
    }
}
