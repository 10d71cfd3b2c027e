//! What planning leaves behind: `solution.json`, `trajectory.csv` and the summary a person reads.
//!
//! Files hold SI units and radians with every digit of a double, and are written beside their
//! place and then renamed together: a reader finds whole files, and none of an earlier plan beside
//! those of a new one. docs/solution-file.md
//! describes the format.

mod base_motion;
mod batch;
mod comparison;
mod comparison_figure;
mod dispersion;
mod file_set;
mod fit;
mod format;
mod lines;
mod optima;
mod output;
mod page;
mod pareto;
mod pareto_figure;
mod peaks;
mod prices;
mod rows;
mod sheet;
mod simulation;
mod summary;
mod verification;

pub use batch::BatchReport;
pub use comparison::{ComparisonReport, ComparisonRow};
pub use comparison_figure::comparison_figure;
pub use dispersion::DispersionReport;
pub use file_set::{FileSet, settled};
pub use fit::{FitReport, reduced};
pub use format::{centimetres, degrees, rotation, seconds};
pub use lines::Lines;
pub use optima::optima;
pub use output::{OutputError, OutputFolder};
pub use page::page;
pub use pareto::{ParetoReport, ParetoRow};
pub use rows::Rows;
pub use sheet::{Sheet, exact, short};
pub use simulation::Simulation;
pub use summary::{summary, verdict};
pub use verification::{in_doubt, verification_json, verification_summary};
