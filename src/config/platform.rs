//! The platform file; docs/platform-file.md describes it.

use super::ConfigError;
use super::document::quoted;
use super::files::{Files, Source};
use super::item::{Item, Section};
use crate::dynamics::Model;
use crate::simulate::{Air, Law, Pad, Platform};
use std::path::Path;

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

    /// One of the platforms shipped in `config/platforms/`, by name ("air-bearing").
    ///
    /// # Errors
    /// [`ConfigError`] where there is none of that name, or it names a body that `robot` has not.
    pub fn shipped(name: &str, robot: &Model) -> Result<Self, ConfigError> {
        let path = format!("config/platforms/{name}.toml");
        Self::read(Path::new(&path), Files::Shipped, robot)
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

fn platform(root: &Item<'_>, robot: &Model) -> Result<Platform, ConfigError> {
    let root = root.section(&[
        "schema",
        "name",
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
        "capture",
    ])?;
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

/// `[controller]`, `[actuator]`, `[joint_friction]`, `[encoder]`.
fn control(root: &Section<'_>, platform: &mut Platform) -> Result<(), ConfigError> {
    if let Some(item) = root.get("controller") {
        let section = item.section(&["law", "period", "bandwidth", "damping_ratio"])?;
        let controller = &mut platform.controller;
        if let Some(item) = section.get("law") {
            let expected = "\"computed-torque\" or \"pd\"";
            let name = item.text(expected)?;
            let laws = [Law::ComputedTorque, Law::PdFeedForward];
            let found = laws.into_iter().find(|law| law.name() == name);
            controller.law = found.ok_or_else(|| item.error(quoted(name), expected))?;
        }
        for (key, value) in [
            ("period", &mut controller.period),
            ("bandwidth", &mut controller.bandwidth),
            ("damping_ratio", &mut controller.damping_ratio),
        ] {
            if let Some(item) = section.get(key) {
                *value = item.positive("a finite number above zero")?;
            }
        }
        // Below a microsecond a plan of some seconds would take hours.
        if let Some(item) = section.get("period").filter(|_| controller.period < 1e-6) {
            return Err(item.unexpected("a sampling period of a microsecond or more, s"));
        }
    }
    let actuator = &mut platform.actuator;
    if let Some(item) = root.get("actuator") {
        let section = item.section(&["delay", "torque_noise", "torque_limit"])?;
        not_negative(
            &section,
            &mut [
                ("delay", &mut actuator.delay),
                ("torque_noise", &mut actuator.torque_noise),
            ],
        )?;
        if let Some(item) = section.get("torque_limit") {
            actuator.torque_limit = match item.as_number() {
                Some(limit) if limit > 0.0 => limit,
                _ => return Err(item.unexpected("a torque above zero, N·m (inf for no limit)")),
            };
        }
    }
    let friction = &mut platform.joint_friction;
    if let Some(item) = root.get("joint_friction") {
        let section = item.section(&["coulomb", "viscous", "slip_rate"])?;
        not_negative(
            &section,
            &mut [
                ("coulomb", &mut friction.coulomb),
                ("viscous", &mut friction.viscous),
            ],
        )?;
        if let Some(item) = section.get("slip_rate") {
            friction.slip_rate = item.positive("a finite rate above zero, rad/s")?;
        }
    }
    let encoder = &mut platform.encoder;
    if let Some(item) = root.get("encoder") {
        not_negative(
            &item.section(&["position_noise", "rate_noise"])?,
            &mut [
                ("position_noise", &mut encoder.position_noise),
                ("rate_noise", &mut encoder.rate_noise),
            ],
        )?;
    }
    Ok(())
}

/// `[bearing]` and `[floor]`.
fn floor(root: &Section<'_>, platform: &mut Platform) -> Result<(), ConfigError> {
    let bearing = &mut platform.bearing;
    if let Some(item) = root.get("bearing") {
        let section = item.section(&[
            "friction",
            "film_drag",
            "slip_speed",
            "base_pads",
            "base_circle",
        ])?;
        not_negative(
            &section,
            &mut [
                ("friction", &mut bearing.friction),
                ("film_drag", &mut bearing.film_drag),
                ("base_circle", &mut bearing.base_circle),
            ],
        )?;
        if let Some(item) = section.get("slip_speed") {
            bearing.slip_speed = item.positive("a finite speed above zero, m/s")?;
        }
        if let Some(item) = section.get("base_pads") {
            bearing.base_pads = item.count(MOST)?;
        }
    }
    let floor = &mut platform.floor;
    if let Some(item) = root.get("floor") {
        let section = item.section(&["tilt", "gravity"])?;
        if let Some(item) = section.get("tilt") {
            let expected = "[along x, along y], two angles below 0.1, rad";
            floor.tilt = pair(item, expected)?;
            if floor.tilt.iter().any(|angle| angle.abs() >= 0.1) {
                return Err(item.unexpected(expected));
            }
        }
        if let Some(item) = section.get("gravity") {
            floor.gravity = item.positive("a finite acceleration above zero, m/s²")?;
        }
    }
    Ok(())
}

/// `[[pads]]`.
fn pads(item: &Item<'_>, robot: &Model) -> Result<Vec<Pad>, ConfigError> {
    let expected = "one [[pads]] table a pad";
    let names: Vec<&str> = std::iter::once(robot.base())
        .chain(robot.joints().iter().map(|joint| &joint.body))
        .map(|body| body.name.as_str())
        .collect();
    let pad = |item: &Item<'_>| {
        let section = item.section(&["body", "at", "load"])?;
        let body = section.require("body", "the name of a body")?;
        let name = body.text("the name of a body")?;
        let found = names.iter().position(|body| *body == name);
        let expected = || format!("a body of the robot: {}", names.join(", "));
        Ok(Pad {
            body: found.ok_or_else(|| body.error(quoted(name), expected()))?,
            at: match section.get("at") {
                Some(item) => item.triple("[x, y, z] in the body's frame, m")?,
                None => [0.0; 3],
            },
            load: match section.get("load") {
                Some(item) => Some(item.positive("a finite mass above zero, kg")?),
                None => None,
            },
        })
    };
    item.as_elements()
        .filter(|elements| !elements.is_empty())
        .ok_or_else(|| item.unexpected(expected))?
        .iter()
        .map(pad)
        .collect()
}

/// `[air]`: one drag area for every body, or a table by body.
fn air(item: &Item<'_>, robot: &Model) -> Result<Air, ConfigError> {
    let section = item.section(&["density", "drag_area"])?;
    let mut air = Air::default();
    if let Some(item) = section.get("density") {
        air.density = item.positive("a finite density above zero, kg/m³")?;
    }
    if let Some(item) = section.get("drag_area") {
        let bodies = super::values::Components {
            what: "body",
            names: std::iter::once(robot.base())
                .chain(robot.joints().iter().map(|joint| &joint.body))
                .map(|body| body.name.clone())
                .collect(),
            single: None,
        };
        air.drag_area = bodies.weights(item)?;
    }
    Ok(air)
}

/// `[umbilical]`, `[payload]`, `[release]` and `[capture]`.
fn surroundings(root: &Section<'_>, platform: &mut Platform) -> Result<(), ConfigError> {
    const POINT: &str = "[x, y, z] in the base's frame, m";
    let umbilical = &mut platform.umbilical;
    if let Some(item) = root.get("umbilical") {
        let section = item.section(&[
            "at",
            "anchor",
            "stiffness",
            "damping",
            "torsion",
            "torsion_damping",
        ])?;
        not_negative(
            &section,
            &mut [
                ("stiffness", &mut umbilical.stiffness),
                ("damping", &mut umbilical.damping),
                ("torsion", &mut umbilical.torsion),
                ("torsion_damping", &mut umbilical.torsion_damping),
            ],
        )?;
        if let Some(item) = section.get("at") {
            umbilical.at = item.triple(POINT)?;
        }
        if let Some(item) = section.get("anchor") {
            umbilical.anchor = Some(pair(item, "[x, y] in inertial axes, m")?);
        }
    }
    let payload = &mut platform.payload;
    if let Some(item) = root.get("payload") {
        let section = item.section(&["mass", "at", "inertia"])?;
        not_negative(
            &section,
            &mut [
                ("mass", &mut payload.mass),
                ("inertia", &mut payload.inertia),
            ],
        )?;
        if let Some(item) = section.get("at") {
            payload.at = item.triple(POINT)?;
        }
    }
    let release = &mut platform.release;
    if let Some(item) = root.get("release") {
        let section = item.section(&["velocity", "rate", "velocity_noise", "rate_noise"])?;
        if let Some(item) = section.get("velocity") {
            release.velocity = pair(item, "[along x, along y], two velocities, m/s")?;
        }
        if let Some(item) = section.get("rate") {
            release.rate = item.number("a finite rate, rad/s")?;
        }
        not_negative(
            &section,
            &mut [
                ("velocity_noise", &mut release.velocity_noise),
                ("rate_noise", &mut release.rate_noise),
            ],
        )?;
    }
    let capture = &mut platform.capture;
    if let Some(item) = root.get("capture") {
        let section = item.section(&["rate", "point", "position_noise", "attitude_noise"])?;
        if let Some(item) = section.get("rate") {
            let expected = format!("frames a second above zero, at most {MOST}, Hz");
            capture.rate = item.positive(&expected)?;
            if capture.rate > MOST as f64 {
                return Err(item.unexpected(expected));
            }
        }
        if let Some(item) = section.get("point") {
            capture.point = item.triple(POINT)?;
        }
        not_negative(
            &section,
            &mut [
                ("position_noise", &mut capture.position_noise),
                ("attitude_noise", &mut capture.attitude_noise),
            ],
        )?;
    }
    Ok(())
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

pub(super) fn pair(item: &Item<'_>, expected: &str) -> Result<[f64; 2], ConfigError> {
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

    fn read(text: &str) -> Result<Platform, ConfigError> {
        let robot = ProblemFile::shipped("table1-smooth").unwrap().problem.robot;
        let texts = [("table.toml", text)];
        PlatformFile::read(Path::new("table.toml"), Files::Kept(&texts), &robot)
            .map(|file| file.platform)
    }

    #[test]
    fn nothing_given_is_the_ideal_platform() {
        let mut platform = read("schema = 1").unwrap();
        assert_eq!(platform.name, "table");
        platform.name = "ideal".into();
        assert_eq!(platform, Platform::default());
        let shipped = read(include_str!("../../config/platforms/ideal.toml")).unwrap();
        assert_eq!(shipped, Platform::default());
    }

    #[test]
    fn every_key_is_read_to_its_place() {
        let platform = read(include_str!("../../config/platforms/air-bearing.toml")).unwrap();
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
