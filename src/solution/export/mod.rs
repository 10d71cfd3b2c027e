//! A saved plan for other tools.
//!
//! Everything is made from [`Samples`]: the motion at the nodes, at even times, or at points between the
//! nodes. The base is described in space, by position and quaternion, also where the robot is planar.
//!
//! | file | does |
//! | --- | --- |
//! | `times` | the instants |
//! | `base` | the base's pose and velocity in space |
//! | `samples` | the motion at the instants |
//! | `columns` | named columns with their units |
//! | `csv`, `parquet` | columns as files |
//! | `joint_trajectory` | messages of ROS 2 |
//! | `mujoco` | a model of MuJoCo that plays the motion |

mod base;
mod columns;
mod csv;
mod joint_trajectory;
mod mujoco;
mod parquet;
mod samples;
mod times;

pub use columns::{Column, columns};
pub use csv::csv;
pub use joint_trajectory::{follow_joint_trajectory, joint_trajectory};
pub use mujoco::{PLAYER, mjcf};
pub use parquet::parquet;
pub use samples::{BaseSample, Samples};

/// The frames that a motion is told in.
pub const FRAMES: &str = "base_position, base_velocity: origin of the robot's root link in inertial axes, which \
    are those of the base at attitude zero and begin at the system's mass centre at the start; base_quaternion: \
    w, x, y, z, from base axes to inertial axes; base_angular_velocity: in base axes";

pub use times::{MOST_ROWS, RateError, Times, even_times};

/// What keeps a motion from being written for others.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The rate of the samples.
    #[error(transparent)]
    Rate(#[from] RateError),
    /// The motion has values that are no numbers.
    #[error(
        "trajectory: at t = {t} s a value is not a number; only finite motions can be exported"
    )]
    NotFinite {
        /// When, s.
        t: f64,
    },
    /// A table that cannot be written.
    #[error("the table cannot be written: {0}")]
    Table(String),
}
