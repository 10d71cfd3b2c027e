//! Mesh refinement: error estimates, the laws that choose meshes, and the loop that solves on one
//! mesh after another.
//!
//! | file | does |
//! | --- | --- |
//! | `settings` | first mesh, tolerances, constants of the laws |
//! | `method` | the methods by name |
//! | `error`, `quadrature` | the error estimate (28), and one of the states themselves |
//! | `violation` | bounds exceeded between the nodes |
//! | `facts` | what a law may ask of the problem |
//! | `law`, `laws` | what a law is, and one file a law |
//! | `curvature` | curvature of a state, eq. (29) and (31) |
//! | `assumptions` | scales, far bounds and patterns, settled after each solve |
//! | `transfer` | a solution with its multipliers from one mesh to another |
//! | `start` | where the loop starts from |
//! | `driver` | a problem ready to be solved on one mesh after another |
//! | `mesh_loop` | the loop over meshes |
//! | `mesh_solve` | the solve on one mesh |
//! | `assess`, `objective_error` | what its solution is worth: errors, bounds, the error in J |
//! | `divergence` | when the errors tell that it leads nowhere |
//! | `outcome` | where the loop ended |
//! | `solve` | all of it by one call |
//! | `start_check`, `failure` | what is asked before the first solve, and why there is none |
//! | `event` | what a monitor is told |
//! | `record`, `verdict` | what a mesh iteration came to |

mod assess;
mod assumptions;
mod curvature;
mod divergence;
mod driver;
mod error;
mod event;
mod facts;
mod failure;
mod law;
mod laws;
mod mesh_loop;
mod mesh_solve;
mod method;
mod objective_error;
mod outcome;
mod quadrature;
mod record;
mod settings;
mod solve;
mod start;
mod start_check;
mod transfer;
mod verdict;
mod violation;

pub use driver::Refinement;
pub use error::{Erring, Errors, midpoint_errors};
pub use event::Event;
pub use facts::Facts;
pub use failure::SolveError;
pub use law::{Assessment, Refined, RefinementLaw};
pub use method::Method;
pub use outcome::{CutShort, Outcome, ReleasedCondition};
pub use quadrature::quadrature_error;
pub use record::{Decision, Record};
pub use settings::{ErrorMeasure, Law, SettingError, Settings};
pub use solve::{SolveSettings, solve, solve_from};
pub use start::Start;
pub use verdict::Verdict;
pub use violation::{Bounded, Violation};
