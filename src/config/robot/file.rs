//! The robot file in TOML; docs/robot-file.md describes it.

use super::MOST_JOINTS;
use super::bodies::Bodies;
use super::description::{Description, Entry};
use crate::config::ConfigError;
use crate::config::document::{Node, quoted};
use crate::config::figures::Figures;
use crate::config::inertia;
use crate::config::item::{Item, Section};
use crate::config::values::joint_range;
use crate::dynamics::{Body, Inertia, Joint, JointKind, JointLimits, MOST_LENGTH, Placement};
use nalgebra::{Unit, Vector3};
use std::sync::Arc;

/// Reads a robot, its bodies changed as `bodies` say; `source` is the name of its file in messages.
pub(super) fn read(
    source: &Arc<str>,
    text: &str,
    bodies: &Bodies,
) -> Result<Description, ConfigError> {
    let document = Node::parse(source, text)?;
    let root =
        Item::root(&document).section(&["schema", "name", "base", "joints", "end_effector"])?;
    crate::config::schema(&root)?;
    let base = root.require("base", "a table with mass, com and inertia")?;
    let name = root.require("name", "a string")?.text("a string")?;
    let frame = Body {
        name: String::new(),
        inertia: Inertia::massless(),
    };
    let mut robot = Description::new(name, frame);
    robot.base = body(&base.section(&BODY)?, ("base", bodies), &mut robot)?;
    let joints = root.require("joints", "one [[joints]] table a joint")?;
    let elements = joints.as_elements().filter(|elements| !elements.is_empty());
    let elements = elements.ok_or_else(|| joints.unexpected("one [[joints]] table a joint"))?;
    if elements.len() > MOST_JOINTS {
        return Err(joints.unexpected(format!("at most {MOST_JOINTS} joints")));
    }
    for item in elements {
        let joint = joint(&item, bodies, &mut robot)?;
        let place = item.node.place.clone();
        robot.joints.push(Entry::new(joint, place));
    }
    if let Some(item) = root.get("end_effector") {
        let section = item.section(&["parent", "origin"])?;
        let carrier = match section.get("parent") {
            Some(parent) => carrier(parent, &robot)?,
            None => Some(robot.joints.len() - 1),
        };
        robot.end_effector = Some((carrier, origin(section.get("origin"))?));
    }
    Ok(robot)
}

const BODY: [&str; 4] = ["name", "mass", "com", "inertia"];

fn joint(item: &Item<'_>, bodies: &Bodies, robot: &mut Description) -> Result<Joint, ConfigError> {
    let section = item.section(&["name", "type", "parent", "origin", "axis", "limits", "body"])?;
    let name = section.require("name", "a string")?;
    let name = unused(name, name.text("a string")?, robot)?;
    let kind = section.require("type", KINDS)?;
    let (kind, continuous) = match kind.text(KINDS)? {
        "revolute" => (JointKind::Revolute, false),
        "continuous" => (JointKind::Revolute, true),
        "prismatic" => (JointKind::Prismatic, false),
        _ => return Err(kind.unexpected(KINDS)),
    };
    let parent = match section.get("parent") {
        Some(parent) => carrier(parent, robot)?,
        None => robot.joints.len().checked_sub(1),
    };
    let expected = "a table with mass, com and inertia";
    let body_item = section.require("body", expected)?;
    let body_section = body_item.section(&BODY)?;
    let default_name = format!("{name}_link");
    let body = body(&body_section, (&default_name, bodies), robot)?;
    unused(
        body_section.get("name").unwrap_or(body_item),
        &body.name,
        robot,
    )?;
    Ok(Joint {
        name,
        kind,
        parent,
        placement: origin(section.get("origin"))?,
        axis: axis(section.get("axis"))?,
        limits: limits(section.get("limits"), continuous)?,
        body,
    })
}

const KINDS: &str = "\"revolute\", \"continuous\" or \"prismatic\"";

fn unused(item: &Item<'_>, name: &str, robot: &Description) -> Result<String, ConfigError> {
    if name.is_empty() {
        return Err(item.unexpected("a name that is not empty"));
    }
    if robot.find(name).is_some() {
        return Err(item.error(format!("{name:?} is given twice"), "a name of its own"));
    }
    Ok(name.into())
}

fn carrier(item: &Item<'_>, robot: &Description) -> Result<Option<usize>, ConfigError> {
    let name = item.text("the name of a body or joint")?;
    let found = robot.find(name).map(|(carrier, _)| carrier);
    found.ok_or_else(|| {
        item.error(
            quoted(name),
            format!("{}, listed before this", robot.expected_names()),
        )
    })
}

/// A body; massless, and among those of `robot` to be settled, where no body is like it.
fn body(
    section: &Section<'_>,
    (default_name, bodies): (&str, &Bodies),
    robot: &mut Description,
) -> Result<Body, ConfigError> {
    let name = match section.get("name") {
        Some(item) => item.text("a string")?,
        None => default_name,
    };
    let change = |figures: &mut Figures| bodies.change(name, figures);
    let inertia = inertia::read_body(section, change)?;
    robot.change(name, bodies, &inertia);
    let inertia = inertia.unwrap_or_else(|unusable| {
        robot.unusable.push((name.into(), unusable));
        Inertia::massless()
    });
    Ok(Body {
        name: name.into(),
        inertia,
    })
}

fn origin(item: Option<&Item<'_>>) -> Result<Placement, ConfigError> {
    let Some(item) = item else {
        return Ok(Placement::identity());
    };
    let section = item.section(&["xyz", "rpy"])?;
    let triple = |name, expected| {
        section
            .get(name)
            .map_or(Ok([0.0; 3]), |item| item.triple(expected))
    };
    let xyz = triple("xyz", "an array of 3 lengths, m")?;
    if xyz.iter().any(|length| length.abs() > MOST_LENGTH) {
        let item = section.get("xyz").unwrap_or(item);
        let found = format!("{xyz:?}");
        return Err(item.error(found, format!("3 lengths of at most {MOST_LENGTH:e} m")));
    }
    let rpy = triple("rpy", "an array of 3 angles, rad")?;
    Ok(Placement::from_xyz_rpy(xyz, rpy))
}

fn axis(item: Option<&Item<'_>>) -> Result<Unit<Vector3<f64>>, ConfigError> {
    let Some(item) = item else {
        return Ok(Vector3::z_axis());
    };
    let expected = "an array of 3 numbers that are not all zero";
    let axis = Vector3::from(item.triple(expected)?);
    // Scaled first, so that neither very small nor very large numbers are lost in the norm.
    Unit::try_new(axis / axis.amax(), 0.5).ok_or_else(|| item.error("0, 0, 0", expected))
}

fn limits(item: Option<&Item<'_>>, continuous: bool) -> Result<JointLimits, ConfigError> {
    let mut limits = JointLimits::NONE;
    let Some(item) = item else { return Ok(limits) };
    let section = item.section(&["position", "velocity", "effort"])?;
    if let Some(item) = section.get("position") {
        if continuous {
            let found = "a limit of a continuous joint";
            return Err(item.error(found, "none, or type = \"revolute\""));
        }
        limits.position = joint_range(item)?;
    }
    for (name, limit) in [
        ("velocity", &mut limits.velocity),
        ("effort", &mut limits.effort),
    ] {
        if let Some(item) = section.get(name) {
            let most = item.as_number().filter(|number| *number >= 0.0);
            *limit =
                most.ok_or_else(|| item.unexpected("a number of zero or above (inf for none)"))?;
        }
    }
    Ok(limits)
}
