//! `[umbilical]`, `[payload]`, `[release]` and `[capture]`.

use super::{MOST, not_negative, pair};
use crate::config::ConfigError;
use crate::config::item::Section;
use crate::simulate::Platform;

/// Reads `[umbilical]`, `[payload]`, `[release]` and `[capture]`.
pub(super) fn surroundings(root: &Section<'_>, platform: &mut Platform) -> Result<(), ConfigError> {
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
