//! The platform file; docs/platform-file.md describes it.

mod control;
mod floor;
mod surroundings;

use super::ConfigError;
use super::files::{Files, Source};
use super::item::{Item, Section};
use crate::dynamics::Model;
use crate::simulate::Platform;
use control::control;
use floor::{air, floor, pads};
use std::path::Path;
use surroundings::surroundings;

/// Most runs, pads and frames a second: beyond them a typing error is more likely than a wish.
const MOST: usize = 100_000;

/// A platform and the file it was read from.
#[derive(Debug, Clone, PartialEq)]
pub struct PlatformFile {
    /// The platform.
    pub platform: Platform,
    /// Path, as given.
    pub path: String,
    /// Its text.
    pub text: String,
}

impl PlatformFile {
    /// Reads the platform file at `path` for `robot`, whose bodies it may name.
    ///
    /// # Errors
    /// [`ConfigError`] for the first thing found wrong in it.
    pub fn load(path: &Path, robot: &Model) -> Result<Self, ConfigError> {
        Self::read(path, Files::Disk, robot)
    }

    /// Reads the text of a platform file; `path` is named in errors.
    ///
    /// # Errors
    /// [`ConfigError`] for the first thing found wrong in it.
    pub fn parse(path: &Path, text: &str, robot: &Model) -> Result<Self, ConfigError> {
        let name = path.display().to_string();
        Self::read(path, Files::Kept(&[(&name, text)]), robot)
    }

    /// One of the platforms shipped in `config/platforms/`, by name ("air-bearing").
    ///
    /// # Errors
    /// [`ConfigError`] where there is none of that name, or it names a body that `robot` has not.
    pub fn shipped(name: &str, robot: &Model) -> Result<Self, ConfigError> {
        let path = format!("config/platforms/{name}.toml");
        Self::read(Path::new(&path), Files::Shipped, robot)
    }

    /// The name of a folder for what comes of it: that of the file.
    ///
    /// # Errors
    /// [`ConfigError`] where the name of the file is none for a folder.
    pub fn folder(&self) -> Result<String, ConfigError> {
        super::problem::name_of(Path::new(&self.path))
    }

    pub(super) fn read(path: &Path, files: Files<'_>, robot: &Model) -> Result<Self, ConfigError> {
        let Source {
            path: source,
            text,
            document,
        } = files.document(path, "a platform file")?;
        let mut platform = platform(&Item::root(&document), robot)?;
        if platform.name.is_empty() {
            let stem = path.file_stem().unwrap_or_default();
            platform.name = stem.to_string_lossy().into_owned();
        }
        Ok(Self {
            platform,
            path: source,
            text,
        })
    }
}

/// Keys that a platform file alone has.
pub(super) const PARTS: [&str; 13] = [
    "seed",
    "repeats",
    "controller",
    "actuator",
    "joint_friction",
    "encoder",
    "bearing",
    "payload",
    "pads",
    "floor",
    "air",
    "umbilical",
    "release",
];

fn platform(root: &Item<'_>, robot: &Model) -> Result<Platform, ConfigError> {
    let mut entries = root.as_entries().into_iter().flatten();
    if let Some(item) = entries.find(|item| item.name == "experiments") {
        let expected = "the platform alone; measurements are for simulate --fit";
        return Err(item.error("measurements", expected));
    }
    let known = [&["schema", "name", "capture"][..], &PARTS].concat();
    let root = root.section(&known)?;
    super::schema(&root)?;
    let mut platform = Platform {
        name: String::new(),
        ..Platform::default()
    };
    if let Some(item) = root.get("name") {
        platform.name = item.text("a string")?.into();
    }
    if let Some(item) = root.get("seed") {
        platform.seed = seed(item)?;
    }
    if let Some(item) = root.get("repeats") {
        platform.repeats = item.count(MOST)?;
    }
    control(&root, &mut platform)?;
    floor(&root, &mut platform)?;
    if let Some(item) = root.get("pads") {
        platform.pads = pads(item, robot)?;
    }
    if let Some(item) = root.get("air") {
        platform.air = air(item, robot)?;
    }
    surroundings(&root, &mut platform)?;
    Ok(platform)
}

/// Reads the keys that are given, finite numbers of zero or above.
fn not_negative(section: &Section<'_>, values: &mut [(&str, &mut f64)]) -> Result<(), ConfigError> {
    let expected = "a finite number, zero or above";
    for (key, value) in values {
        if let Some(item) = section.get(key) {
            **value = item.number(expected)?;
            if **value < 0.0 {
                return Err(item.unexpected(expected));
            }
        }
    }
    Ok(())
}

pub(in crate::config) fn pair(item: &Item<'_>, expected: &str) -> Result<[f64; 2], ConfigError> {
    let elements = item
        .as_elements()
        .ok_or_else(|| item.unexpected(expected))?;
    let numbers = elements
        .iter()
        .map(|element| element.number("a finite number"))
        .collect::<Result<Vec<_>, _>>()?;
    numbers.try_into().map_err(|_| item.unexpected(expected))
}

fn seed(item: &Item<'_>) -> Result<u64, ConfigError> {
    match item.node.value {
        super::document::Value::Integer(number) => u64::try_from(number).ok(),
        _ => None,
    }
    .ok_or_else(|| item.unexpected("a whole number, zero or above"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::ProblemFile;
    use crate::simulate::{Law, Pad};

    fn read(text: &str) -> Result<Platform, ConfigError> {
        let problem = ProblemFile::shipped("table1-smooth").unwrap().problem;
        let texts = [("table.toml", text)];
        PlatformFile::read(Path::new("table.toml"), Files::Kept(&texts), &problem.robot)
            .map(|file| file.platform)
    }

    #[test]
    fn nothing_given_is_the_ideal_platform() {
        let mut platform = read("schema = 1").unwrap();
        assert_eq!(platform.name, "table");
        platform.name = "ideal".into();
        assert_eq!(platform, Platform::default());
        let shipped = read(include_str!("../../../config/platforms/ideal.toml")).unwrap();
        assert_eq!(shipped, Platform::default());
    }

    #[test]
    fn every_key_is_read_to_its_place() {
        let platform = read(include_str!("../../../config/platforms/air-bearing.toml")).unwrap();
        assert_eq!((platform.seed, platform.repeats), (1, 20));
        assert_eq!(platform.actuator.delay, 2e-3);
        assert_eq!(platform.joint_friction.coulomb, 0.05);
        assert_eq!(platform.bearing.base_circle, 0.12);
        assert_eq!(platform.floor.tilt, [2e-5, -1e-5]);
        assert_eq!(platform.air.drag_area, [0.08, 0.03, 0.03]);
        assert_eq!(platform.umbilical.at, [-0.14, 0.0, 0.0]);
        assert_eq!(platform.release.rate_noise, 5e-4);
        assert_eq!(platform.capture.attitude_noise, 5e-4);
        let platform = read(
            "schema = 1\npads = [{ body = \"forearm\", at = [0.5, 0, 0] }]\n\
             air.drag_area = { upper_arm = 0.2 }\npayload.inertia = 0.1\n\
             actuator.torque_limit = inf\ncontroller.law = \"pd\"\n",
        )
        .unwrap();
        let pad = Pad {
            body: 2,
            at: [0.5, 0.0, 0.0],
            load: None,
        };
        assert_eq!(platform.pads, [pad]);
        assert_eq!(platform.air.drag_area, [0.0, 0.2, 0.0]);
        assert_eq!(platform.payload.inertia, 0.1);
        assert_eq!(platform.controller.law, Law::PdFeedForward);
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        for (text, expected) in [
            (
                "seed = 1",
                "table.toml: schema: missing; expected schema = 1",
            ),
            (
                "schema = 1\n[floor]\ntillt = [0, 0]",
                "table.toml:3: floor.tillt: unknown key; did you mean 'tilt'?",
            ),
            (
                "schema = 1\nfloor.tilt = 1e-5",
                "table.toml:2: floor.tilt: 1e-5; expected [along x, along y], two angles below \
                 0.1, rad",
            ),
            (
                "schema = 1\nfloor.tilt = [0.2, 0.0]",
                "table.toml:2: floor.tilt: an array of 2 values; expected [along x, along y], \
                 two angles below 0.1, rad",
            ),
            (
                "schema = 1\n[[pads]]\nbody = \"hand\"",
                "table.toml:3: pads[0].body: \"hand\"; expected a body of the robot: base, \
                 upper_arm, forearm",
            ),
            (
                "schema = 1\nbearing.friction = -1e-5",
                "table.toml:2: bearing.friction: -1e-5; expected a finite number, zero or above",
            ),
            (
                "schema = 1\ncontroller.law = \"pid\"",
                "table.toml:2: controller.law: \"pid\"; expected \"computed-torque\" or \"pd\"",
            ),
            (
                "schema = 1\ncontroller.period = 1e-9",
                "table.toml:2: controller.period: 1e-9; expected a sampling period of a \
                 microsecond or more, s",
            ),
            (
                "schema = 1\nseed = -1",
                "table.toml:2: seed: -1; expected a whole number, zero or above",
            ),
        ] {
            assert_eq!(read(text).unwrap_err().to_string(), expected);
        }
    }
}
