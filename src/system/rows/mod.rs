//! Path and boundary rows of the problem, one file a kind.

mod end_effector;
mod keep_out;
mod rotation_angle;
mod way_point;

pub(crate) use end_effector::GoalRows;
pub(crate) use keep_out::KeepOutRow;
pub(crate) use rotation_angle::{ROTATION, TurnLimits, rows as rotation_rows};
pub(crate) use way_point::formulate;
