//! The optimal control problem as the transcription sees it, eq. (14) to (20).
//!
//! Any problem that implements [`Ocp`] can be solved, not only the manipulator's.

mod derivatives;
mod elastic;
mod formulation;
mod interval;
mod invariants;
mod point;
mod problem;
mod released;
mod validation;

pub use derivatives::PointDerivatives;
pub use elastic::{Elastic, LimitGroup, Limited};
pub use formulation::{Formulation, Quantity, WayPoint};
pub use interval::Interval;
pub(crate) use invariants::{Dependent, dependent};
pub use point::{Ends, InteriorPoint, Point};
pub use problem::Ocp;
pub(crate) use released::Released;
pub use validation::FormulationError;

// The entry point has its name here, where the problem is written; it stands above this folder.
pub use crate::refine::{SolveError, SolveSettings as Settings, solve, solve_from};
