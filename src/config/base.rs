//! `[base]`: a spacecraft, and how the base attitude is described.

use super::document::quoted;
use super::item::{Item, hint};
use super::robot::Robot;
use super::{ConfigError, inertia};
use crate::dynamics::attitude::SpatialAttitude;

const ATTITUDE: &str = "attitude";

/// Attaches the spacecraft to `robot`, where there is one; returns the attitude's description,
/// where one is named.
pub(super) fn read(
    item: &Item<'_>,
    robot: &mut Robot,
) -> Result<Option<SpatialAttitude>, ConfigError> {
    const SPACECRAFT: [&str; 3] = ["mass", "com", "inertia"];
    let known = [&SPACECRAFT[..], &[ATTITUDE]].concat();
    let section = item.section(&known)?;
    let attitude = section.get(ATTITUDE).map(attitude).transpose()?;
    if attitude.is_none() || SPACECRAFT.iter().any(|name| section.get(name).is_some()) {
        robot.attach(&inertia::read(&section)?);
    }
    Ok(attitude)
}

fn attitude(item: &Item<'_>) -> Result<SpatialAttitude, ConfigError> {
    let names = SpatialAttitude::ALL.map(SpatialAttitude::name);
    let [first, second, third] = names.map(quoted);
    let expected = format!("{first}, {second} or {third}");
    let name = item.text(&expected)?;
    let found = SpatialAttitude::ALL.into_iter().find(|a| a.name() == name);
    found.ok_or_else(|| {
        let suggestion = match hint(name, &names) {
            near if near.starts_with("did you mean") => format!(" ({near})"),
            _ => String::new(),
        };
        item.error(quoted(name), format!("{expected}{suggestion}"))
    })
}
