//! `[controller]`, `[actuator]`, `[joint_friction]` and `[encoder]`.

use super::not_negative;
use crate::config::ConfigError;
use crate::config::document::quoted;
use crate::config::item::Section;
use crate::simulate::{Law, Platform};

/// Reads `[controller]`, `[actuator]`, `[joint_friction]` and `[encoder]`.
pub(super) fn control(root: &Section<'_>, platform: &mut Platform) -> Result<(), ConfigError> {
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
