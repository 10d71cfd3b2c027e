//! The robot: read from its own file, some joints locked, an end effector chosen.

mod description;
mod file;

use super::document::quoted;
use super::files::Files;
use super::item::{Item, hint};
use super::{ConfigError, Place};
use crate::dynamics::Model;
use description::Description;
use std::path::Path;

/// The file a robot was read from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RobotFile {
    /// Path, as found from the problem file.
    pub path: String,
    /// Its text.
    pub text: String,
}

/// Reads what the key `robot` names, a file relative to `folder`.
pub(super) fn read(
    item: &Item<'_>,
    folder: &Path,
    files: &Files,
) -> Result<(Model, RobotFile), ConfigError> {
    const EXPECTED: &str =
        "the path of a robot file, or a table with the keys file, lock and end_effector";
    if item.as_entries().is_none() {
        let (description, file) = load(item, item.text(EXPECTED)?, folder, files)?;
        return Ok((model(item, description)?, file));
    }
    let section = item.section(&["file", "lock", "end_effector"])?;
    let path = section.require("file", "the path of a robot file")?;
    let (mut description, file) = load(path, path.text("a path")?, folder, files)?;
    if let Some(item) = section.get("end_effector") {
        let name = item.text("the name of a body or joint")?;
        if !description.set_end_effector(name) {
            return Err(item.error(quoted(name), description.expected_names()));
        }
    }
    if let Some(locked) = section.get("lock") {
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
        return Ok((model(locked, description)?, file));
    }
    Ok((model(item, description)?, file))
}

fn model(item: &Item<'_>, description: Description) -> Result<Model, ConfigError> {
    description
        .into_model()
        .map_err(|source| ConfigError::Model {
            place: item.node.place.clone(),
            key: item.key.clone(),
            source,
        })
}

fn load(
    item: &Item<'_>,
    path: &str,
    folder: &Path,
    files: &Files,
) -> Result<(Description, RobotFile), ConfigError> {
    let full = folder.join(path);
    let path = full.display().to_string();
    match full.extension().and_then(|extension| extension.to_str()) {
        Some("toml") => {}
        Some("urdf" | "xacro" | "xml") => {
            let found = "URDF robots are not read yet";
            return Err(item.error(
                found,
                "a robot file in TOML, as docs/robot-file.md describes",
            ));
        }
        _ => return Err(item.error(quoted(&path), "a file that ends in .toml")),
    }
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
    let description = file::read(&path.as_str().into(), &text)?;
    Ok((description, RobotFile { path, text }))
}
