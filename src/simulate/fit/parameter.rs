//! What of a platform can be fitted.

use crate::simulate::Platform;

/// One number of a platform, by its key in the platform file.
#[derive(Debug, Clone, Copy)]
pub struct Parameter {
    /// Key, `floor.tilt[0]`.
    pub key: &'static str,
    /// Unit.
    pub unit: &'static str,
    field: fn(&mut Platform) -> &mut f64,
}

impl PartialEq for Parameter {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key
    }
}

impl Parameter {
    /// The parameter of that key.
    pub fn find(key: &str) -> Option<Self> {
        ALL.into_iter().find(|parameter| parameter.key == key)
    }

    /// Keys of all there are.
    pub fn keys() -> Vec<&'static str> {
        ALL.iter().map(|parameter| parameter.key).collect()
    }

    /// Sets it.
    pub fn set(&self, platform: &mut Platform, value: f64) {
        *(self.field)(platform) = value;
    }

    /// Its value.
    pub fn get(&self, platform: &Platform) -> f64 {
        *(self.field)(&mut platform.clone())
    }
}

const fn parameter(
    key: &'static str,
    unit: &'static str,
    field: fn(&mut Platform) -> &mut f64,
) -> Parameter {
    Parameter { key, unit, field }
}

const ALL: [Parameter; 24] = [
    parameter("floor.tilt[0]", "rad", |p| &mut p.floor.tilt[0]),
    parameter("floor.tilt[1]", "rad", |p| &mut p.floor.tilt[1]),
    parameter("bearing.friction", "", |p| &mut p.bearing.friction),
    parameter("bearing.film_drag", "N s/m", |p| &mut p.bearing.film_drag),
    parameter("umbilical.at[0]", "m", |p| &mut p.umbilical.at[0]),
    parameter("umbilical.at[1]", "m", |p| &mut p.umbilical.at[1]),
    parameter("umbilical.stiffness", "N/m", |p| &mut p.umbilical.stiffness),
    parameter("umbilical.damping", "N s/m", |p| &mut p.umbilical.damping),
    parameter("umbilical.torsion", "N·m/rad", |p| {
        &mut p.umbilical.torsion
    }),
    parameter("umbilical.torsion_damping", "N·m s/rad", |p| {
        &mut p.umbilical.torsion_damping
    }),
    parameter("payload.mass", "kg", |p| &mut p.payload.mass),
    parameter("payload.at[0]", "m", |p| &mut p.payload.at[0]),
    parameter("payload.at[1]", "m", |p| &mut p.payload.at[1]),
    parameter("payload.inertia", "kg m²", |p| &mut p.payload.inertia),
    parameter("joint_friction.coulomb", "N·m", |p| {
        &mut p.joint_friction.coulomb
    }),
    parameter("joint_friction.viscous", "N·m s/rad", |p| {
        &mut p.joint_friction.viscous
    }),
    parameter("controller.bandwidth", "rad/s", |p| {
        &mut p.controller.bandwidth
    }),
    parameter("actuator.delay", "s", |p| &mut p.actuator.delay),
    parameter("release.velocity[0]", "m/s", |p| &mut p.release.velocity[0]),
    parameter("release.velocity[1]", "m/s", |p| &mut p.release.velocity[1]),
    parameter("release.rate", "rad/s", |p| &mut p.release.rate),
    parameter("capture.point[0]", "m", |p| &mut p.capture.point[0]),
    parameter("capture.point[1]", "m", |p| &mut p.capture.point[1]),
    parameter("bearing.base_circle", "m", |p| &mut p.bearing.base_circle),
];
