//! The robot: read from its own file, some joints locked, an end effector chosen.

mod description;
mod file;
mod notes;
mod urdf;

use super::document::quoted;
use super::files::Files;
use super::item::{Item, hint};
use super::{ConfigError, Place};
use crate::dynamics::{Inertia, Model, ModelError, Placement};
use crate::problem::{Problem, Shape};
use description::{Description, Entry};
use std::path::Path;

/// The file a robot was read from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RobotFile {
    /// Path, as found from the problem file.
    pub path: String,
    /// Its text.
    pub text: String,
}

/// A robot that has been read and can still be loaded with a spacecraft.
pub(super) struct Robot {
    /// The key that names it.
    place: Place,
    key: String,
    description: Description,
    /// Its file.
    pub file: RobotFile,
}

impl Robot {
    /// Attaches a spacecraft rigidly to the base, given in the frame of the root link.
    pub(super) fn attach(&mut self, spacecraft: &Inertia) {
        self.description.load_base(spacecraft);
    }

    /// The model.
    pub(super) fn model(&self) -> Result<Model, ConfigError> {
        let entries = &self.description.joints;
        refuse(entries)?;
        self.description.model().map_err(|cause| match &cause {
            ModelError::Base { .. } => self.error(
                cause.to_string(),
                "a heavier root link, or a spacecraft under it: [base] with mass and inertia",
            ),
            ModelError::MasslessJoint { joint, .. } => {
                let entry = entries.iter().find(|entry| entry.joint.name == *joint);
                ConfigError::Format {
                    place: entry.map_or(&self.place, |entry| &entry.place).clone(),
                    message: format!(
                        "{cause}; expected bodies with mass, a fixed joint, or this one in robot.lock"
                    ),
                }
            }
            _ => ConfigError::Model {
                place: self.place.clone(),
                key: self.key.clone(),
                cause,
            },
        })
    }

    /// The joint whose body is or carries the body `name` (`None` for the base), and the pose of
    /// that body's frame there. Bodies that were welded to others are found as well.
    pub(super) fn body(&self, name: &str) -> Option<(Option<usize>, Placement)> {
        match self.description.body(name) {
            None if name == "base" => Some((None, Placement::identity())),
            found => found,
        }
    }

    /// The shapes of the body `name` in its own frame, as its `<collision>` elements give them.
    ///
    /// # Errors
    /// That of the first element that is no box, cylinder or sphere.
    pub(super) fn collisions(&self, name: &str) -> Result<Vec<Shape>, ConfigError> {
        let of = |name: &str| self.description.collisions(name).iter().cloned().collect();
        match self.description.body(name) {
            None if name == "base" => of(&self.description.base.name),
            _ => of(name),
        }
    }

    /// Names of all bodies, those welded to others included.
    pub(super) fn body_names(&self) -> Vec<&str> {
        self.description.body_names().collect()
    }

    /// Name of the body at whose frame the end effector is, with an offset where there is one.
    pub(super) fn end_effector(&self) -> Option<String> {
        self.description.end_effector_name()
    }

    /// What a user should know of how the robot was read.
    pub(super) fn notes(&self, problem: &Problem) -> Vec<String> {
        notes::of(&self.description.joints, &self.file.path, problem)
    }

    fn error(&self, found: String, expected: &str) -> ConfigError {
        ConfigError::Value {
            place: self.place.clone(),
            key: self.key.clone(),
            found,
            expected: expected.into(),
        }
    }
}

/// Refuses joints that cannot move by themselves: the first with its reason, all by name.
fn refuse(entries: &[Entry]) -> Result<(), ConfigError> {
    let mut refused = entries.iter().filter(|entry| entry.refusal.is_some());
    let Some(mut error) = refused.next().and_then(|entry| entry.refusal.clone()) else {
        return Ok(());
    };
    let others: Vec<String> = refused.map(|e| format!("'{}'", e.joint.name)).collect();
    if let (ConfigError::Value { expected, .. }, false) = (&mut error, others.is_empty()) {
        expected.push_str(&format!("; likewise {}", others.join(", ")));
    }
    Err(error)
}

/// Reads what the key `robot` names, a file relative to `folder`.
pub(super) fn read(
    item: &Item<'_>,
    folder: &Path,
    files: &Files<'_>,
) -> Result<Robot, ConfigError> {
    const EXPECTED: &str =
        "the path of a robot file, or a table with the keys file, lock and end_effector";
    let robot = |item: &Item<'_>, (mut description, file): (Description, RobotFile)| {
        description.sort();
        Robot {
            place: item.node.place.clone(),
            key: item.key.clone(),
            description,
            file,
        }
    };
    if item.as_entries().is_none() {
        let loaded = load(item, item.text(EXPECTED)?, folder, files)?;
        few_enough(item, &loaded.0)?;
        return Ok(robot(item, loaded));
    }
    let section = item.section(&["file", "lock", "end_effector"])?;
    let path = section.require("file", "the path of a robot file")?;
    let (mut description, file) = load(path, path.text("a path")?, folder, files)?;
    few_enough(path, &description)?;
    if let Some(item) = section.get("end_effector") {
        let name = item.text("the name of a body or joint")?;
        if !description.set_end_effector(name) {
            return Err(item.error(quoted(name), description.expected_names()));
        }
    }
    let locked = section.get("lock");
    if let Some(locked) = locked {
        for item in locked.entries("a table of joint positions by name")? {
            let position = item.number("the finite position the joint is locked at, rad or m")?;
            if !description.lock(item.name, position) {
                let names = description.joint_names();
                return Err(ConfigError::UnknownKey {
                    place: item.node.place.clone(),
                    hint: hint(item.name, &names),
                    key: item.key,
                });
            }
        }
    }
    Ok(robot(locked.unwrap_or(item), (description, file)))
}

/// Most joints that move, those that are locked included: inertia matrices are dense.
const MOST_JOINTS: usize = 500;

fn few_enough(item: &Item<'_>, robot: &Description) -> Result<(), ConfigError> {
    match robot.joints.len() {
        joints if joints > MOST_JOINTS => {
            let found = format!("{joints} joints that move");
            Err(item.error(found, format!("at most {MOST_JOINTS}")))
        }
        _ => Ok(()),
    }
}

fn load(
    item: &Item<'_>,
    path: &str,
    folder: &Path,
    files: &Files<'_>,
) -> Result<(Description, RobotFile), ConfigError> {
    let full = folder.join(path);
    let path = full.display().to_string();
    let extension = full
        .extension()
        .map(|extension| extension.to_string_lossy());
    let is_urdf = match extension.map(|e| e.to_ascii_lowercase()).as_deref() {
        Some("toml") => false,
        Some("urdf" | "xml") => true,
        Some("xacro") => {
            let expected = "URDF: run xacro on the file first, xacro arm.urdf.xacro > arm.urdf";
            return Err(item.error(quoted(&path), expected));
        }
        _ => return Err(item.error(quoted(&path), "a file that ends in .toml or .urdf")),
    };
    let text = files
        .read(&full)
        .map_err(|reason| ConfigError::Unreadable {
            place: Place {
                source: format!("{}: {}: {path}", item.node.place, item.key).into(),
                line: None,
            },
            reason,
            expected: "a robot file, by a path relative to the problem file",
        })?;
    let source = path.as_str().into();
    let description = if is_urdf {
        let stem = full.file_stem().unwrap_or_default().to_string_lossy();
        urdf::read(&source, &text, &stem)?
    } else {
        file::read(&source, &text)?
    };
    Ok((description, RobotFile { path, text }))
}
