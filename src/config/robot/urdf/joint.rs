//! `<joint>`: what it joins, where, and how it may move.

use super::element::Element;
use super::origin;
use crate::config::faults::Faults;
use crate::config::robot::description::Unlimited;
use crate::config::{ConfigError, Place};
use crate::dynamics::{JointKind, JointLimits, Placement};
use nalgebra::{Unit, Vector3};

/// A joint between two links, which it names.
#[derive(Debug)]
pub(super) struct Joint {
    pub name: String,
    pub place: Place,
    pub parent: End,
    pub child: End,
    /// Pose of the joint frame in the parent link's frame.
    pub placement: Placement,
    pub motion: Motion,
}

/// The link at one end of a joint.
#[derive(Debug)]
pub(super) struct End {
    pub link: String,
    /// The error of there being no such link.
    pub missing: ConfigError,
}

/// What a joint lets its link do.
#[derive(Debug)]
pub(super) enum Motion {
    /// Nothing.
    Fixed,
    /// Move along or about one axis.
    Axis(Axis),
    /// Everything. The error is that of a robot in which it may not.
    Floating(ConfigError),
}

/// A motion along or about one axis.
#[derive(Debug)]
pub(super) struct Axis {
    pub kind: JointKind,
    pub axis: Unit<Vector3<f64>>,
    pub limits: JointLimits,
    pub unlimited: Unlimited,
    /// Why it cannot move by itself.
    pub refusal: Option<ConfigError>,
}

const KINDS: &str = "\"revolute\", \"continuous\", \"prismatic\" or \"fixed\"";

/// Reads a joint; `None` where it does not say what it joins. What is wrong with the rest has a
/// stand-in, so that the search for faults goes on.
pub(super) fn read(element: &Element<'_, '_>, faults: &mut Faults) -> Option<Joint> {
    let name = faults.keep(element.name("name"));
    let motion = motion(element, faults);
    let parent = faults.keep(end(element, "parent"));
    let child = faults.keep(end(element, "child"));
    let placement = faults.keep(origin(element));
    Some(Joint {
        name: name?,
        place: element.place(),
        parent: parent?,
        child: child?,
        placement: placement.unwrap_or_else(Placement::identity),
        motion,
    })
}

fn motion(element: &Element<'_, '_>, faults: &mut Faults) -> Motion {
    let Some(kind) = faults.keep(element.attribute("type", KINDS)) else {
        return Motion::Fixed;
    };
    match kind.text {
        "fixed" => Motion::Fixed,
        "revolute" => Motion::Axis(axis(element, JointKind::Revolute, false, faults)),
        "continuous" => Motion::Axis(axis(element, JointKind::Revolute, true, faults)),
        "prismatic" => Motion::Axis(axis(element, JointKind::Prismatic, false, faults)),
        "floating" => Motion::Floating(kind.unexpected(
            "\"revolute\", \"continuous\", \"prismatic\" or \"fixed\"; only the base may float, \
             on a root link that has no mass and no other joint",
        )),
        _ => {
            faults.push(kind.unexpected(KINDS));
            Motion::Fixed
        }
    }
}

fn end(element: &Element<'_, '_>, tag: &str) -> Result<End, ConfigError> {
    let end = element.require(tag, "the name of a link")?;
    Ok(End {
        link: end.name("link")?,
        missing: end
            .attribute("link", "the name of a link")?
            .unexpected("the name of a link of this file"),
    })
}

fn axis(element: &Element<'_, '_>, kind: JointKind, continuous: bool, faults: &mut Faults) -> Axis {
    let mut limits = JointLimits::NONE;
    let given = faults.keep(element.child("axis")).flatten();
    let axis = given.and_then(|element| faults.keep(direction(&element)));
    let unlimited = match faults.keep(element.child("limit")).flatten() {
        Some(element) => limit(&element, continuous, &mut limits, faults),
        None => Unlimited {
            position: !continuous,
            velocity: !continuous,
            effort: !continuous,
        },
    };
    Axis {
        kind,
        axis: axis.unwrap_or_else(Vector3::x_axis),
        limits,
        unlimited,
        refusal: faults.keep(mimic(element)).flatten(),
    }
}

fn direction(element: &Element<'_, '_>) -> Result<Unit<Vector3<f64>>, ConfigError> {
    let expected = "3 finite numbers that are not all zero";
    let xyz = element.attribute("xyz", expected)?;
    let axis = Vector3::from(xyz.triple(expected)?);
    // Scaled first, so that neither very small nor very large numbers are lost in the norm.
    Unit::try_new(axis / axis.amax(), 0.5).ok_or_else(|| xyz.unexpected(expected))
}

/// Limits of this size (rad, m, N·m, N) and above stand for none.
const ENDLESS: f64 = 1e9;

/// `<limit>`. Zeros, which would keep the joint from moving, are what exporters write for want of
/// a value.
fn limit(
    element: &Element<'_, '_>,
    continuous: bool,
    limits: &mut JointLimits,
    faults: &mut Faults,
) -> Unlimited {
    let mut unlimited = Unlimited::default();
    if !continuous {
        let mut end = |name| match element.get(name) {
            Some(attribute) => faults.keep(attribute.number("a number, rad or m")),
            None => Some(0.0),
        };
        if let (Some(lower), Some(upper)) = (end("lower"), end("upper")) {
            if lower > upper || lower == f64::INFINITY || upper == f64::NEG_INFINITY {
                let found = format!("lower {lower} above upper {upper}");
                faults.push(element.error(found, "lower not above upper"));
            }
            unlimited.position = lower == 0.0 && upper == 0.0;
            if !unlimited.position {
                limits.position = [lower, upper].map(endless);
            }
        }
    }
    for (name, limit, missing) in [
        ("velocity", &mut limits.velocity, &mut unlimited.velocity),
        ("effort", &mut limits.effort, &mut unlimited.effort),
    ] {
        let most = faults.keep(largest(element, name)).unwrap_or(0.0);
        *missing = most == 0.0;
        if most > 0.0 {
            *limit = endless(most);
        }
    }
    unlimited
}

/// A largest speed or effort; 0 where none is given.
fn largest(element: &Element<'_, '_>, name: &str) -> Result<f64, ConfigError> {
    let expected = "a number of zero or above";
    let Some(attribute) = element.get(name) else {
        return Ok(0.0);
    };
    match attribute.number(expected)? {
        most if most < 0.0 => Err(attribute.unexpected(expected)),
        most => Ok(most),
    }
}

/// The limit, infinite where it stands for none.
fn endless(limit: f64) -> f64 {
    if limit.abs() < ENDLESS {
        limit
    } else {
        limit * f64::INFINITY
    }
}

/// A joint that follows another moves in no way of its own.
fn mimic(element: &Element<'_, '_>) -> Result<Option<ConfigError>, ConfigError> {
    let Some(mimic) = element.child("mimic")? else {
        return Ok(None);
    };
    let other = mimic.name("joint")?;
    Ok(Some(mimic.error(
        format!("follows joint '{other}'"),
        "a joint that moves by itself, or one held at a position: name it in robot.lock of the \
         problem file",
    )))
}
