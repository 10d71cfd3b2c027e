//! A robot alone, without a problem.

use super::failure::Failure;
use super::show::{rounded, show, show_interval};
use super::{Outcome, terminal};
use crate::config::{Starter, StarterJoint};
use crate::ocp::Interval;
use crate::problem::Unit;
use crate::report::Lines;
use std::path::Path;

/// `check` of a URDF file: what is in it, and whether it can be planned for.
pub(super) fn check(urdf: &Path) -> Result<Outcome, Failure> {
    let starter = Starter::of_urdf(urdf, &urdf.display().to_string())?;
    let mut lines = Lines::default();
    list(&starter, urdf, &mut lines);
    lines.add("mass of the robot", format!("{} kg", rounded(starter.mass)));
    let motion = match starter.is_planar {
        true => "planar: all joints move in one plane",
        false => "spatial",
    };
    lines.add("motion", motion);
    for change in &starter.repairs {
        terminal::warn(&format!("warning: {change}"));
    }
    let path = urdf.display();
    terminal::print(&format!(
        "{path}: a robot\n\n{}\nA problem for it: ffsm-ipopt init DIR --urdf {path}\n",
        lines.finish()
    ))?;
    Ok(Outcome::Done)
}

/// What the robot has, and what was chosen of it.
pub(super) fn list(starter: &Starter, urdf: &Path, lines: &mut Lines) {
    lines.add(
        "robot",
        format!("{}, from {}", starter.robot, urdf.display()),
    );
    lines.add("joints", starter.joints.len().to_string());
    for joint in &starter.joints {
        let StarterJoint {
            name, kind, link, ..
        } = joint;
        let [lower, upper] = joint.limits.position;
        let position = show_interval(Unit::position(*kind), &Interval::new(lower, upper));
        let most = |unit, most: f64| match most.is_finite() {
            true => format!(", {}", show(unit, most)),
            false => String::new(),
        };
        let velocity = most(Unit::rate(*kind), joint.limits.velocity);
        let effort = most(Unit::effort(*kind), joint.limits.effort);
        let limits = match position.as_str() {
            "none" => "no position limit".into(),
            _ => position,
        };
        let held = match joint.locked {
            Some(at) => format!("; held at {}", show(Unit::position(*kind), at)),
            None => String::new(),
        };
        let value = format!("moves {link}: {limits}{velocity}{effort}{held}");
        lines.add(&format!("  {name}"), value);
    }
    lines.add(
        "links",
        format!("{}: {}", starter.links.len(), starter.links.join(", ")),
    );
    let (root, spacecraft) = &starter.base;
    let base = match spacecraft {
        Some(mass) => format!("{root}, on a spacecraft of {mass} kg: give your own in [base]"),
        None => root.clone(),
    };
    lines.add("base", base);
    lines.add("end effector", &starter.end_effector);
}
