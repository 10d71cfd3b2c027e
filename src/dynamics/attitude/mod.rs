//! How the base's orientation is described: one angle in the plane; roll-pitch-yaw, a unit
//! quaternion or modified Rodrigues parameters in space.
//!
//! Derived in docs/algorithms.md#attitude.

mod description;
mod kind;
mod planar;
mod quaternion;
mod rodrigues;
mod roll_pitch_yaw;
mod rotation_angle;
mod spatial;

pub use description::Attitude;
pub use kind::SpatialAttitude;
pub use planar::PlanarAngle;
