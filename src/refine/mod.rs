//! Mesh refinement: error estimates, the laws that choose meshes, and the loop that solves on one
//! mesh after another.
//!
//! | file | does |
//! | --- | --- |
//! | `settings` | first mesh, tolerances, constants of the laws |
//! | `method` | the methods by name |
//! | `error`, `quadrature` | the error estimate (28), and one of the states themselves |
//! | `violation` | bounds exceeded between the nodes |
//! | `law`, `laws` | what a law is, and one file a law |
//! | `curvature` | curvature of a state, eq. (29) and (31) |
//! | `transfer` | a solution with its multipliers from one mesh to another |
//! | `driver` | the loop |
//! | `record`, `verdict` | what a mesh iteration came to |

mod curvature;
mod driver;
mod error;
mod law;
mod laws;
mod method;
mod quadrature;
mod record;
mod settings;
mod transfer;
mod verdict;
mod violation;

pub use driver::{Event, Outcome, Refinement, Start};
pub use error::{Errors, midpoint_errors};
pub use law::{Assessment, Refined, RefinementLaw};
pub use method::Method;
pub use quadrature::quadrature_error;
pub use record::{Decision, Record};
pub use settings::{SettingError, Settings};
pub use verdict::Verdict;
pub use violation::{Bounded, Violation, violations};
