//! The robot: read from its own file, some joints locked, an end effector chosen.

mod bodies;
mod description;
mod file;
mod look;
mod model;
mod notes;
mod outline;
mod repair;
mod urdf;

use super::appearance::{Appearance, Part};
use super::document::quoted;
use super::files::Files;
use super::item::{Item, hint};
use super::robot_file::RobotFile;
use super::{ConfigError, Place};
use crate::dynamics::{Inertia, Placement};
use crate::problem::{Problem, Shape};
use bodies::Bodies;
use description::Description;
pub(super) use outline::{Outline, OutlineJoint};
use repair::Repair;
use std::path::Path;

/// A robot that has been read and can still be loaded with a spacecraft.
pub(super) struct Robot {
    /// The key that names it.
    place: Place,
    key: String,
    description: Description,
    /// What of it may be changed.
    repair: Repair,
    /// The spacecraft that is attached.
    spacecraft: Option<Inertia>,
    /// What was changed, a line each; known once it is a model.
    pub changes: Vec<String>,
    /// Its file.
    pub file: RobotFile,
}

impl Robot {
    /// Attaches a spacecraft rigidly to the base, given in the frame of the root link.
    pub(super) fn attach(&mut self, spacecraft: &Inertia) {
        self.description.add(spacecraft, None);
        self.spacecraft = Some(spacecraft.clone());
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

    /// Mass properties of the bodies that `robot.bodies` changes, each in its own frame, as they
    /// went into the model.
    pub(super) fn changed(&self) -> &[(String, Inertia)] {
        &self.description.changed
    }

    /// Mass properties of the spacecraft that is attached, in the frame of the root link.
    pub(super) fn spacecraft(&self) -> Option<&Inertia> {
        self.spacecraft.as_ref()
    }

    /// What the bodies look like.
    pub(super) fn appearance(&self) -> Appearance {
        let looks = self.description.looks.iter();
        let parts = looks.filter_map(|(link, looks)| {
            // Links above a base that floats are left out.
            let (joint, frame) = self.description.body(link)?;
            let part = move |look: &look::Look| Part {
                link: link.clone(),
                joint,
                placement: frame.then(&look.placement),
                form: look.form.clone(),
                colour: look.colour,
                is_collision: look.is_collision,
            };
            Some(looks.iter().map(part))
        });
        Appearance {
            parts: parts.flatten().collect(),
            has_spacecraft: self.spacecraft.is_some(),
        }
    }

    /// Name of the body at whose frame the end effector is, with an offset where there is one.
    pub(super) fn end_effector(&self) -> Option<String> {
        self.description.end_effector_name()
    }

    /// What a user should know of how the robot was read.
    pub(super) fn notes(&self, problem: &Problem) -> Vec<String> {
        notes::of(&self.description.joints, &self.file.path, problem)
    }
}

/// Reads what the key `robot` names, a file relative to `folder`.
pub(super) fn read(
    item: &Item<'_>,
    folder: &Path,
    files: &Files<'_>,
) -> Result<Robot, ConfigError> {
    const EXPECTED: &str =
        "the path of a robot file, or a table with the keys file, lock and end_effector";
    let robot = |item: &Item<'_>, repair, (mut description, file): (Description, RobotFile)| {
        description.sort();
        Robot {
            place: item.node.place.clone(),
            key: item.key.clone(),
            description,
            repair,
            spacecraft: None,
            changes: Vec::new(),
            file,
        }
    };
    if item.as_entries().is_none() {
        let loaded = load(
            item,
            (item.text(EXPECTED)?, &Bodies::default()),
            folder,
            files,
        )?;
        few_enough(item, &loaded.0)?;
        return Ok(robot(item, Repair::default(), loaded));
    }
    let known = [
        &["file", "lock", "end_effector", "bodies"][..],
        &Repair::KEYS,
    ]
    .concat();
    let section = item.section(&known)?;
    let repair = Repair::read(&section)?;
    let path = section.require("file", "the path of a robot file")?;
    let bodies = section.get("bodies").map(Bodies::read).transpose()?;
    let bodies = bodies.unwrap_or_default();
    let (mut description, file) = load(path, (path.text("a path")?, &bodies), folder, files)?;
    bodies.check(&description.body_names().collect::<Vec<_>>())?;
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
    Ok(robot(locked.unwrap_or(item), repair, (description, file)))
}

/// Whether a file's name is that of a URDF and not of a TOML file, or what was expected.
fn is_urdf(path: &Path) -> Result<bool, &'static str> {
    let extension = path
        .extension()
        .map(|extension| extension.to_ascii_lowercase());
    match extension
        .as_deref()
        .and_then(|extension| extension.to_str())
    {
        Some("toml") => Ok(false),
        Some("urdf" | "xml") => Ok(true),
        Some("xacro") => Err("URDF: run xacro on the file first, xacro arm.urdf.xacro > arm.urdf"),
        _ => Err("a file that ends in .toml or .urdf"),
    }
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
    (path, bodies): (&str, &Bodies),
    folder: &Path,
    files: &Files<'_>,
) -> Result<(Description, RobotFile), ConfigError> {
    let full = folder.join(path);
    let path = full.display().to_string();
    let is_urdf = is_urdf(&full).map_err(|expected| item.error(quoted(&path), expected))?;
    let read = if is_urdf {
        Files::read_xml
    } else {
        Files::read
    };
    let text = read(*files, &full).map_err(|reason| ConfigError::Unreadable {
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
        urdf::read(&source, &text, (&stem, bodies))?
    } else {
        file::read(&source, &text, bodies)?
    };
    Ok((description, RobotFile { path, text }))
}
