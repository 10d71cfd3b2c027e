//! The ground platform: every physical parameter, zero where the effect is off.
//!
//! Planar air-bearing platforms and their error sources: T. Rybus, K. Seweryn, "Planar
//! air-bearing microgravity simulators", doi:10.1016/j.actaastro.2015.12.018.

/// What plays a plan: controller, actuators, floor, air, cable, measurement.
///
/// The default is a platform with nothing in the way of free motion and an exact measurement.
#[derive(Debug, Clone, PartialEq)]
pub struct Platform {
    /// Name, for reports.
    pub name: String,
    /// Seed of everything random.
    pub seed: u64,
    /// Runs, each with random numbers of its own.
    pub repeats: usize,
    /// The joints' tracking controller.
    pub controller: Controller,
    /// From command to torque.
    pub actuator: Actuator,
    /// Friction in the joints.
    pub joint_friction: JointFriction,
    /// What the controller sees of the joints.
    pub encoder: Encoder,
    /// Friction between pads and floor.
    pub bearing: Bearing,
    /// What the base carries beyond the robot's description.
    pub payload: Payload,
    /// Pads by hand; empty for the standard ones, see [`Bearing`].
    pub pads: Vec<Pad>,
    /// The floor.
    pub floor: Floor,
    /// The air around.
    pub air: Air,
    /// Cable or hose on the base.
    pub umbilical: Umbilical,
    /// How the system is let go.
    pub release: Release,
    /// Motion capture.
    pub capture: Capture,
}

impl Default for Platform {
    fn default() -> Self {
        Self {
            name: "ideal".into(),
            seed: 1,
            repeats: 1,
            controller: Controller::default(),
            actuator: Actuator::default(),
            joint_friction: JointFriction::default(),
            encoder: Encoder::default(),
            bearing: Bearing::default(),
            payload: Payload::default(),
            pads: Vec::new(),
            floor: Floor::default(),
            air: Air::default(),
            umbilical: Umbilical::default(),
            release: Release::default(),
            capture: Capture::default(),
        }
    }
}

impl Platform {
    /// The same platform with nothing random: what its runs scatter around.
    pub fn without_noise(&self) -> Self {
        let mut quiet = self.clone();
        quiet.repeats = 1;
        quiet.actuator.torque_noise = 0.0;
        quiet.encoder = Encoder::default();
        quiet.release.velocity_noise = 0.0;
        quiet.release.rate_noise = 0.0;
        quiet.capture.position_noise = 0.0;
        quiet.capture.attitude_noise = 0.0;
        quiet
    }
}

/// How the joint torques are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Law {
    /// τ = H(θ)(θ̈_d + 2ζω ė + ω² e) + Cθ̇ with the measured joints, eq. (6).
    ComputedTorque,
    /// Feed-forward of the planned motion and a PD term that is scaled by the diagonal of H at
    /// the start: τ = τ_d + diag(H₀)(2ζω ė + ω² e).
    PdFeedForward,
}

impl Law {
    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::ComputedTorque => "computed-torque",
            Self::PdFeedForward => "pd",
        }
    }
}

/// The joints' tracking controller: sampled, the torque held from one sample to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Controller {
    /// Control law.
    pub law: Law,
    /// Sampling period, s.
    pub period: f64,
    /// Natural frequency ω of the tracking error, rad/s.
    pub bandwidth: f64,
    /// Damping ratio ζ of the tracking error.
    pub damping_ratio: f64,
}

impl Default for Controller {
    fn default() -> Self {
        Self {
            law: Law::ComputedTorque,
            period: 1e-3,
            bandwidth: 20.0,
            damping_ratio: 1.0,
        }
    }
}

/// From command to torque.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Actuator {
    /// Time from sampling the joints to the torque that answers, s.
    pub delay: f64,
    /// Standard deviation of the torque about the command, drawn anew each sample, N·m or N.
    pub torque_noise: f64,
    /// Largest torque, N·m or N; infinite for none.
    pub torque_limit: f64,
}

impl Default for Actuator {
    fn default() -> Self {
        Self {
            delay: 0.0,
            torque_noise: 0.0,
            torque_limit: f64::INFINITY,
        }
    }
}

/// Friction in every joint: an internal torque, which leaves momentum alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointFriction {
    /// Coulomb friction, N·m or N.
    pub coulomb: f64,
    /// Viscous friction, N·m s/rad or N s/m.
    pub viscous: f64,
    /// Rate below which Coulomb friction fades, rad/s or m/s.
    pub slip_rate: f64,
}

impl Default for JointFriction {
    fn default() -> Self {
        Self {
            coulomb: 0.0,
            viscous: 0.0,
            slip_rate: 1e-3,
        }
    }
}

/// Standard deviations of the joint measurement, drawn anew each sample.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Encoder {
    /// Joint positions, rad or m.
    pub position_noise: f64,
    /// Joint rates, rad/s or m/s.
    pub rate_noise: f64,
}

/// Residual friction of the air bearings.
///
/// Without pads by hand the base stands on `base_pads` of them, evenly on a circle about its mass
/// centre, and every other body with mass on one under its mass centre: the arm's weight is
/// carried where it acts, and none of it by the joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bearing {
    /// Coulomb coefficient: contact over dust and scratches, hose drag and the like.
    pub friction: f64,
    /// Viscous drag of the air film of one pad, N s/m: viscosity × area / film thickness.
    pub film_drag: f64,
    /// Speed below which Coulomb friction fades, m/s.
    pub slip_speed: f64,
    /// Pads under the base.
    pub base_pads: usize,
    /// Radius of the circle they stand on, m.
    pub base_circle: f64,
}

impl Default for Bearing {
    fn default() -> Self {
        Self {
            friction: 0.0,
            film_drag: 0.0,
            slip_speed: 1e-4,
            base_pads: 3,
            base_circle: 0.1,
        }
    }
}

/// What is fixed to the base and not in the robot's description, which plan and controller know:
/// computer, batteries, air bottles.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Payload {
    /// Mass, kg.
    pub mass: f64,
    /// Its mass centre, in the base frame, m.
    pub at: [f64; 3],
    /// Rotational inertia about that and the plane's normal, kg m².
    pub inertia: f64,
}

/// One pad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pad {
    /// The body it carries: 0 for the base, j + 1 for that of joint j.
    pub body: usize,
    /// Where, in the body's frame, m.
    pub at: [f64; 3],
    /// Mass it carries, kg; an equal share of the body's where not given.
    pub load: Option<f64>,
}

/// The floor: a plane that is nearly level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Floor {
    /// Angles by which it falls along the inertial x and y, rad.
    pub tilt: [f64; 2],
    /// Gravity, m/s².
    pub gravity: f64,
}

impl Default for Floor {
    fn default() -> Self {
        Self {
            tilt: [0.0; 2],
            // Standard gravity.
            gravity: 9.80665,
        }
    }
}

/// Drag of the air on every body: ½ρ C_d A v² against the motion of its mass centre.
#[derive(Debug, Clone, PartialEq)]
pub struct Air {
    /// Density, kg/m³.
    pub density: f64,
    /// Drag coefficient times frontal area, m²: base first, then one a joint; empty for none.
    pub drag_area: Vec<f64>,
}

impl Default for Air {
    fn default() -> Self {
        Self {
            density: 1.2,
            drag_area: Vec::new(),
        }
    }
}

/// A cable or hose from the base to the room: a linear spring and damper in the plane and about
/// its normal.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Umbilical {
    /// Where it leaves the base, in the base frame, m.
    pub at: [f64; 3],
    /// Where in the room it pulls that point to, inertial axes, m; where the point starts unless
    /// given.
    pub anchor: Option<[f64; 2]>,
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N s/m.
    pub damping: f64,
    /// Stiffness against turning, N·m/rad.
    pub torsion: f64,
    /// Damping of turning, N·m s/rad.
    pub torsion_damping: f64,
}

/// How the system is let go: motion of the whole at t₀ beyond the planned.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Release {
    /// Velocity, m/s.
    pub velocity: [f64; 2],
    /// Rate of turning about the system's mass centre, rad/s.
    pub rate: f64,
    /// Standard deviation of each velocity component from run to run, m/s.
    pub velocity_noise: f64,
    /// Standard deviation of the rate from run to run, rad/s.
    pub rate_noise: f64,
}

/// Motion capture of the base. The controller does not see it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capture {
    /// Frames a second, Hz.
    pub rate: f64,
    /// The point of the base that is tracked, in the base frame, m.
    pub point: [f64; 3],
    /// Standard deviation of each coordinate, m.
    pub position_noise: f64,
    /// Standard deviation of the attitude, rad.
    pub attitude_noise: f64,
}

impl Default for Capture {
    fn default() -> Self {
        Self {
            rate: 100.0,
            point: [0.0; 3],
            position_noise: 0.0,
            attitude_noise: 0.0,
        }
    }
}
