//! Problem, robot and platform files: TOML in, a validated
//! [`Problem`](crate::problem::Problem) or [`Platform`](crate::simulate::Platform) out.
//!
//! A document is parsed with the line of every value ([`Place`]), values given on the command
//! line are laid over it ([`Overrides`]), and one reader a table turns it into a problem. Every
//! error is one line that names the file, the line, the key, what stands there and what was
//! expected. docs/problem-file.md, docs/robot-file.md and docs/platform-file.md describe the
//! formats.

mod appearance;
mod base;
mod batch;
mod dispersion;
mod distribution;
mod document;
mod error;
mod faults;
mod figures;
mod files;
mod fit;
mod goal;
mod inertia;
mod item;
mod keep_out;
mod key_path;
mod long_way;
mod overrides;
mod platform;
mod problem;
mod read_back;
pub(crate) mod regular;
mod robot;
mod robot_file;
mod starter;
mod surface;
mod tables;
mod trust;
mod values;
mod way_point;
mod xml_text;

pub use appearance::{Appearance, Drawing, Drawn, Form, Part};
pub use batch::{BatchFile, BatchRow, Cell, CellKind};
pub use dispersion::{Dispersed, Dispersion, Perturbation};
pub use distribution::Distribution;
pub use error::{ConfigError, Place, Remedy};
pub use fit::{Experiment, FitFile, Hypothesis, PlanSource};
pub use overrides::Overrides;
pub use platform::PlatformFile;
pub use problem::ProblemFile;
pub use robot_file::RobotFile;
pub use starter::{Starter, StarterJoint};
pub use surface::{Surface, SurfaceCopies, SurfaceCopy};
pub use trust::{trust_options, trusts_options};

use document::Value;
use item::Section;

/// The only version of the file formats so far.
const SCHEMA: i64 = 1;

/// Checks the key `schema`.
fn schema(root: &Section<'_>) -> Result<(), ConfigError> {
    let item = root.require("schema", "schema = 1")?;
    match item.node.value {
        Value::Integer(SCHEMA) => Ok(()),
        _ => Err(item.unexpected("1, the only schema this version reads")),
    }
}
