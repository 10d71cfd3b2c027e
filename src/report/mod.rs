//! What planning leaves behind: `solution.json`, `trajectory.csv` and the summary a person reads.
//!
//! Files hold SI units and radians with every digit of a double, and are written beside their
//! place and then renamed: a reader finds the whole file or the one before. docs/solution-file.md
//! describes the format.

mod build;
mod comparison;
mod comparison_figure;
mod convert;
mod csv;
mod fit;
mod format;
mod front;
mod front_figure;
mod json;
mod lines;
mod number;
mod output;
mod page;
mod peaks;
mod provenance;
mod read;
mod rows;
mod sheet;
mod simulation;
mod solution;
mod summary;
mod verification;
mod warm_start;

pub use build::Build;
pub use comparison::{ComparisonReport, ComparisonRow};
pub use comparison_figure::comparison_figure;
pub use convert::solution;
pub use csv::trajectory_csv;
pub use fit::{FitReport, reduced};
pub use format::{centimetres, degrees, rotation, seconds};
pub use front::{FrontReport, FrontRow};
pub use json::to_json;
pub use lines::Lines;
pub use output::{OutputError, OutputFolder};
pub use page::page;
pub use provenance::Provenance;
pub use read::{Saved, SolutionError, read_solution};
pub use rows::Rows;
pub use sheet::{Sheet, exact, short};
pub use simulation::Simulation;
pub use solution::{
    Diagnosis, Goal, Iterate, Iteration, LimitFinding, Mesh, Metrics, Solution, Timing, Trajectory,
    Verification,
};
pub use summary::{summary, verdict};
pub use verification::{verification_json, verification_summary};
pub use warm_start::read_warm_start;
