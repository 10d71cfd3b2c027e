//! The problem file as text.

use super::choice::{Choice, rounded};
use super::posture::Ends;
use crate::config::robot::Outline;
use std::fmt::Write;

/// What the robot needs before it can be planned for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Remedies {
    repair: bool,
    /// kg.
    minimum_mass: Option<f64>,
}

impl Remedies {
    /// None, then each, then both.
    pub(super) fn tried(robot: &Outline) -> [Self; 4] {
        let mass: f64 = robot.joints.iter().map(|joint| joint.mass).sum();
        let least = if mass > 0.0 {
            rounded(0.01 * mass)
        } else {
            1.0
        };
        [
            (false, None),
            (true, None),
            (false, Some(least)),
            (true, Some(least)),
        ]
        .map(|(repair, minimum_mass)| Self {
            repair,
            minimum_mass,
        })
    }
}

/// The problem of moving `robot` between `ends`; `file` is the path of its file.
pub(super) fn problem(
    robot: &Outline,
    choice: &Choice,
    remedies: &Remedies,
    ends: &Ends,
    file: &str,
) -> String {
    let mut keys = vec![
        format!("file = {}", quoted(file)),
        format!("end_effector = {}", quoted(&choice.end_effector)),
    ];
    if remedies.repair {
        keys.push("repair = \"inertia\"".into());
    }
    if let Some(mass) = remedies.minimum_mass {
        keys.push(format!("minimum_mass = {mass:?}"));
    }
    let locked = robot.joints.iter().zip(&choice.locked);
    let locked: Vec<String> = locked
        .filter_map(|(joint, at)| Some(format!("{} = {:?}", key(&joint.name), (*at)?)))
        .collect();
    if !locked.is_empty() {
        keys.push(format!("lock = {{ {} }}", locked.join(", ")));
    }
    let table = |of: fn(&(String, f64, f64)) -> f64| -> String {
        let pairs = ends
            .joints
            .iter()
            .map(|joint| format!("{} = {:?}", key(&joint.0), of(joint)));
        pairs.collect::<Vec<_>>().join(", ")
    };
    let mut text = format!(
        "# A first problem for this robot: change it into one's own. ffsm-ipopt check says what was\n\
         # understood; docs/problem-file.md lists all keys. SI units and radians.\n\
         schema = 1\n\
         name = {}\n\
         robot = {{ {} }}\n\n",
        quoted(&name(&robot.name)),
        keys.join(", "),
    );
    text += &spacecraft(choice.spacecraft);
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "[task]\n\
         duration = {:?}  # s\n\
         initial.joints = {{ {} }}\n\
         final.joints = {{ {} }}\n\n",
        ends.duration,
        table(|joint| joint.1),
        table(|joint| joint.2),
    );
    text + REST
}

const REST: &str = "[limits]  # joint limits are the URDF's; a number holds for all joints
# joint_velocity = 0.2       # rad/s
# control = 0.5              # rad/s², joint accelerations
# base_attitude = 0.1        # rad, along the whole path
# final_base_attitude = 0.01 # rad, at the end

[cost]
preset = \"still\"           # weights by the task's own sizes: the base first, along the path and at
                           # the end; \"gentle\": in balance with the joints' effort
# peak_base_attitude = 1.0 # a weight of one's own comes on top, or instead of the preset's

[mesh]
segments = 10
points = 5
tolerance = 1e-5
";

/// `[base]`: a cube as dense as spacecraft are, its top at the root link.
fn spacecraft(mass: Option<f64>) -> String {
    const DENSITY: f64 = 300.0;
    let Some(mass) = mass else {
        return "# [base]: none, the root link is heavy enough to be the spacecraft.\n\n".into();
    };
    let side = (mass / DENSITY).cbrt();
    let moment = rounded(mass * side * side / 6.0);
    format!(
        "[base]  # the spacecraft that the root link is fixed to: give your own\n\
         mass = {mass:?}  # kg\n\
         inertia = [{moment:?}, {moment:?}, {moment:?}]  # kg m², about its own mass centre\n\
         com = [0.0, 0.0, {:?}]  # m, in the axes of the root link\n\n",
        -rounded(0.5 * side)
    )
}

/// The robot's name as that of a folder.
fn name(robot: &str) -> String {
    let harmless = |c: char| {
        if c.is_alphanumeric() || "-_".contains(c) {
            c
        } else {
            '-'
        }
    };
    let name: String = robot.chars().map(harmless).collect();
    match name.trim_matches('-') {
        "" => "robot".into(),
        name => name.into(),
    }
}

/// A bare key where it can be one.
fn key(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || "-_".contains(c);
    if !name.is_empty() && name.chars().all(bare) {
        name.into()
    } else {
        quoted(name)
    }
}

/// A basic string of TOML.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => quoted += &format!("\\u{:04X}", u32::from(c)),
            c => quoted.push(c),
        }
    }
    quoted + "\""
}
