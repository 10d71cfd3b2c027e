//! The optimal control problem as the transcription sees it, eq. (14) to (20).
//!
//! Any problem that implements [`Ocp`] can be solved, not only the manipulator's.

mod derivatives;
mod elastic;
mod elastic_derivatives;
mod interval;
mod problem;

pub use derivatives::PointDerivatives;
pub use elastic::{Elastic, LimitGroup, Limited};
pub use interval::Interval;
pub use problem::{Ends, Formulation, Ocp, Passage, Point, Quantity, WayPoint};
