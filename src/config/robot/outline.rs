//! What a robot's file has, before anything is chosen: joints, limits, links.

use super::bodies::Bodies;
use super::description::{Description, Entry};
use super::{is_urdf, urdf};
use crate::config::files::Files;
use crate::config::{ConfigError, Place};
use crate::dynamics::{JointKind, JointLimits};
use std::path::Path;

/// A robot as its URDF file has it.
#[derive(Debug)]
pub(in crate::config) struct Outline {
    pub name: String,
    /// The file's text.
    pub text: String,
    pub root: String,
    /// Mass of the root link with what is fixed to it, kg, where it can be used as it is and
    /// resists every motion.
    pub root_mass: Option<f64>,
    /// Joints that are not fixed, depth-first.
    pub joints: Vec<OutlineJoint>,
    /// Links by the joint that carries them (`None`: the root), those fixed to others included.
    pub links: Vec<(String, Option<usize>)>,
    /// The link of the only tip, where there is but one, with the joint that carries it.
    pub tip: Option<(String, Option<usize>)>,
}

/// A joint that is not fixed.
#[derive(Debug)]
pub(in crate::config) struct OutlineJoint {
    pub name: String,
    pub kind: JointKind,
    pub limits: JointLimits,
    /// The joint that carries it.
    pub parent: Option<usize>,
    /// The link that it moves.
    pub link: String,
    /// Mass of that link with what is fixed to it, kg.
    pub mass: f64,
    /// Whether it follows another.
    pub follows: bool,
}

impl Outline {
    /// Reads the URDF file at `path`.
    ///
    /// # Errors
    /// [`ConfigError`] where it cannot be read as a robot, whatever is chosen.
    pub(in crate::config) fn load(path: &Path) -> Result<Self, ConfigError> {
        const EXPECTED: &str = "a URDF file";
        let place = Place {
            source: path.display().to_string().into(),
            line: None,
        };
        if let Err(expected) = is_urdf(path) {
            let message = format!("expected {expected}");
            return Err(ConfigError::Format { place, message });
        }
        let text = Files::Disk
            .read_xml(path)
            .map_err(|reason| ConfigError::Unreadable {
                place: place.clone(),
                reason,
                expected: EXPECTED,
            })?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let mut robot = urdf::read(&place.source, &text, (&stem, &Bodies::default()))?;
        if !robot.faults.is_empty() {
            return Err(robot.faults.into_error(place));
        }
        robot.sort();
        Ok(Self::of(&robot, text))
    }

    fn of(robot: &Description, text: String) -> Self {
        let carrier = |name: &str| robot.body(name).and_then(|(joint, _)| joint);
        let known = |name: &String| !robot.unusable.iter().any(|(body, _)| body == name);
        let links = robot
            .body_names()
            .map(|name| (name.to_owned(), carrier(name)));
        let tip = robot.end_effector.as_ref().and_then(|(joint, _)| {
            let name = robot.end_effector_name()?;
            robot.body(&name).map(|_| (name, *joint))
        });
        let root = &robot.base;
        let usable = root.inertia.is_solid() && known(&root.name);
        Self {
            name: robot.name.clone(),
            text,
            root: root.name.clone(),
            root_mass: usable.then(|| root.inertia.mass()),
            joints: robot.joints.iter().map(joint).collect(),
            links: links.collect(),
            tip,
        }
    }
}

fn joint(entry: &Entry) -> OutlineJoint {
    let joint = &entry.joint;
    OutlineJoint {
        name: joint.name.clone(),
        kind: joint.kind,
        limits: joint.limits,
        parent: joint.parent,
        link: joint.body.name.clone(),
        mass: joint.body.inertia.mass(),
        follows: entry.refusal.is_some(),
    }
}
