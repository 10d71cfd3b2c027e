//! What floor, air and cable do to the bodies.
//!
//! | effect | model | source |
//! | --- | --- | --- |
//! | pads | F = −(μN/√(v² + v_s²) + c)·v at each pad: Coulomb friction, smooth through zero, and the drag of the air film | H. Olsson et al., doi:10.1016/S0947-3580(98)70113-X, sections 2 and 3 |
//! | tilt | mg sin(angle) at each mass centre | |
//! | air | F = −½ρ C_d A‖v‖v at each mass centre | |
//! | umbilical | F = −k(p − p₀) − cṗ at its point, M = −k_t(η − η₀) − c_t η̇ on the base | |

use super::dynamics::{BodyState, Wrench};
use super::plane::PlanarBodies;
use super::platform::Platform;
use nalgebra::Vector2;

/// Pads as they stand under a robot: one body each, with the weight it carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// The body, 0 for the base.
    pub body: usize,
    /// Where, in the body's planar frame, m.
    pub at: Vector2<f64>,
    /// Weight on it, N.
    pub weight: f64,
}

/// External forces on one robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Forces {
    supports: Vec<Support>,
    friction: f64,
    film_drag: f64,
    slip_speed: f64,
    /// Acceleration along the floor, m/s².
    slope: Vector2<f64>,
    /// ½ρ C_d A of every body, kg/m.
    drag: Vec<f64>,
    masses: Vec<f64>,
    /// Where the cable leaves the base, in its planar frame, m.
    cable: Vector2<f64>,
    anchor: Vector2<f64>,
    stiffness: f64,
    damping: f64,
    torsion: f64,
    torsion_damping: f64,
    /// Attitude without torsion, rad.
    untwisted: f64,
}

impl Forces {
    /// The forces of `platform` on `robot`, whose base starts at `position` (m) and `attitude`
    /// (rad).
    pub fn new(
        platform: &Platform,
        robot: &PlanarBodies,
        position: &Vector2<f64>,
        attitude: f64,
    ) -> Self {
        let floor = &platform.floor;
        let umbilical = &platform.umbilical;
        let cable = robot.flat(0, &umbilical.at);
        let start = BodyState::placed(position, attitude);
        let half_density = 0.5 * platform.air.density;
        Self {
            supports: supports(platform, robot),
            friction: platform.bearing.friction,
            film_drag: platform.bearing.film_drag,
            slip_speed: platform.bearing.slip_speed,
            slope: Vector2::from(floor.tilt.map(|angle| floor.gravity * angle.sin())),
            drag: platform
                .air
                .drag_area
                .iter()
                .map(|area| half_density * area)
                .collect(),
            masses: robot.bodies().iter().map(|body| body.mass).collect(),
            cable,
            anchor: umbilical
                .anchor
                .map_or_else(|| start.point(&cable).0, Vector2::from),
            stiffness: umbilical.stiffness,
            damping: umbilical.damping,
            torsion: umbilical.torsion,
            torsion_damping: umbilical.torsion_damping,
            untwisted: attitude,
        }
    }

    /// Writes the wrench on every body as placed; `attitude` is the base's angle, rad.
    pub fn wrenches(&self, states: &[BodyState], attitude: f64, out: &mut [Wrench]) {
        for (wrench, mass) in out.iter_mut().zip(&self.masses) {
            *wrench = Wrench {
                force: self.slope * *mass,
                moment: 0.0,
            };
        }
        if self.friction != 0.0 || self.film_drag != 0.0 {
            for support in &self.supports {
                let state = &states[support.body];
                let (point, velocity) = state.point(&support.at);
                let dry = self.friction * support.weight
                    / (velocity.norm_squared() + self.slip_speed * self.slip_speed).sqrt();
                let force = velocity * -(dry + self.film_drag);
                out[support.body].add(&force, &point, &state.center);
            }
        }
        for ((wrench, drag), state) in out.iter_mut().zip(&self.drag).zip(states) {
            wrench.force -= state.velocity * (drag * state.velocity.norm());
        }
        let base = &states[0];
        if self.stiffness != 0.0 || self.damping != 0.0 {
            let (point, velocity) = base.point(&self.cable);
            let force = (self.anchor - point) * self.stiffness - velocity * self.damping;
            out[0].add(&force, &point, &base.center);
        }
        out[0].moment -=
            self.torsion * (attitude - self.untwisted) + self.torsion_damping * base.omega;
    }
}

/// The pads of `platform` under `robot`.
pub fn supports(platform: &Platform, robot: &PlanarBodies) -> Vec<Support> {
    let gravity = platform.floor.gravity;
    let bodies = robot.bodies();
    if !platform.pads.is_empty() {
        return platform
            .pads
            .iter()
            .map(|pad| {
                let sharing = platform.pads.iter().filter(|p| p.body == pad.body).count();
                let load = pad.load.unwrap_or(bodies[pad.body].mass / sharing as f64);
                Support {
                    body: pad.body,
                    at: robot.flat(pad.body, &pad.at),
                    weight: gravity * load,
                }
            })
            .collect();
    }
    let bearing = &platform.bearing;
    let count = bearing.base_pads;
    let circle = (0..count).map(|k| {
        let angle = std::f64::consts::TAU * k as f64 / count as f64;
        let arm = Vector2::new(angle.cos(), angle.sin()) * bearing.base_circle;
        Support {
            body: 0,
            at: bodies[0].center + arm,
            weight: gravity * bodies[0].mass / count as f64,
        }
    });
    let arm = bodies.iter().enumerate().skip(1);
    let under = arm.filter(|(_, body)| body.mass > 0.0);
    circle
        .chain(under.map(|(i, body)| Support {
            body: i,
            at: body.center,
            weight: gravity * body.mass,
        }))
        .collect()
}
