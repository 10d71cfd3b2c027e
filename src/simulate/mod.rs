//! The ground platform: a plan played on a planar air-bearing table, with what disturbs it there.
//!
//! The robot moves by the full, unreduced equations of motion (4) in its plane, under external
//! forces on every body; a sampled controller tracks the planned joint path; motion capture
//! watches the base. With everything off it reproduces the planned base motion.
//!
//! | file | does |
//! | --- | --- |
//! | `platform` | the physical parameters |
//! | `plane` | the robot as bodies in its plane |
//! | `dynamics` | (4) in the plane, with a wrench on every body |
//! | `forces` | pads, tilt, air, umbilical |
//! | `reference`, `tracking` | the planned joints, the controller |
//! | `noise` | seeded random numbers |
//! | `player`, `run` | a plan made ready, one run of it |
//! | `figures` | what runs come to |
//! | `fit` | platform parameters from measurements |

pub mod dynamics;
mod figures;
pub mod fit;
pub mod forces;
mod noise;
pub mod plane;
mod platform;
mod player;
mod reference;
mod run;
mod tracking;

pub use figures::{Figures, Spread};
pub use platform::{
    Actuator, Air, Bearing, Capture, Controller, Encoder, Floor, JointFriction, Law, Pad, Payload,
    Platform, Release, Umbilical,
};
pub use player::Player;
pub use run::Run;

use crate::verify::VerifyError;

/// A plan that cannot be played.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimulateError {
    /// The platform is flat.
    #[error(
        "robot '{robot}' does not move in a plane, and the platform is a flat floor; expected a robot whose joint axes are all parallel, see check"
    )]
    NotPlanar {
        /// Name of the robot.
        robot: String,
    },
    /// The plan cannot be used.
    #[error(transparent)]
    Plan(#[from] VerifyError),
    /// The motion runs away.
    #[error(
        "the simulated motion runs away at t = {time:.6} s; expected a controller that is stable with the platform's period, delay and friction: lower controller.bandwidth or actuator.delay"
    )]
    Stuck {
        /// Time reached, s.
        time: f64,
    },
    /// More samples than memory should be asked for.
    #[error(
        "{samples:.1e} samples along the plan; expected at most {most:e}: a longer controller.period or a lower capture.rate"
    )]
    TooManySamples {
        /// Samples there would be.
        samples: f64,
        /// How many there may be.
        most: f64,
    },
    /// A figure of the motion overflows.
    #[error(
        "the simulated motion is not finite; expected a platform and a robot whose figures are not so far apart in size"
    )]
    NotFinite,
}
