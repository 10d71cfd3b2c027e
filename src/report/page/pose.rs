//! Where the base is in the picture.

use crate::dynamics::Model;
use crate::dynamics::attitude::SpatialAttitude;
use crate::system::Trajectory;
use crate::verify::bodies::{BaseMotion, orientation};
use nalgebra::{Matrix3, Vector3};

/// Where the base is in row `k`, in inertial axes.
pub(super) fn base_pose(robot: &Model, rows: &Trajectory, k: usize) -> BaseMotion {
    let attitude = rows.attitude.unwrap_or(SpatialAttitude::RollPitchYaw);
    let position = match rows.base_position[k][..] {
        [x, y] => from_picture(robot) * Vector3::new(x, y, 0.0),
        ref position => Vector3::from_column_slice(position),
    };
    BaseMotion::placed(
        position,
        orientation(robot, attitude, &rows.base_attitude[k]),
    )
}

/// From the axes of the picture to those that bodies are given in: the plane lies in the first two.
pub(super) fn from_picture(robot: &Model) -> Matrix3<f64> {
    robot
        .plane()
        .map_or_else(Matrix3::identity, |plane| plane.basis)
}
