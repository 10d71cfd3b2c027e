//! The saved plan: its schema, written and read, where it comes from, and what can start from it.
//!
//! Files hold SI units and radians with every digit of a double; docs/solution-file.md describes
//! the format.

mod again;
mod build;
mod csv;
pub mod dataset;
pub mod export;
mod json;
pub(crate) mod number;
mod provenance;
mod read;
mod schema;
mod shape;
mod warm_start;
mod write;

pub use build::Build;
pub use csv::trajectory_csv;
pub use json::to_json;
pub use provenance::{ProblemSource, Provenance, TextFile};
pub use read::{Saved, SolutionError, parse_solution, read_solution};
pub use schema::{
    CostTerm, Diagnosis, Goal, Iterate, Iteration, JointColumn, LimitFinding, Mesh, Metrics,
    Optimum, Search, Solution, Timing, Trajectory, Verification,
};
pub use warm_start::{OtherRobot, WarmStart, read_warm_start, warm_start};
pub use write::{search, solution};

pub(crate) use write::{timing, verification};
