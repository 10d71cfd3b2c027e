//! Mesh refinement: error estimate (28), the adaptive law (29) to (32), the global method, and
//! the loop that solves on one mesh after another.

mod curvature;
mod driver;
mod error;
mod law;
mod quadrature;
mod record;
mod settings;
mod transfer;
mod violation;

pub use driver::{Event, Outcome, Refinement, Start};
pub use error::{Errors, midpoint_errors};
pub use law::refine;
pub use quadrature::quadrature_error;
pub use record::{Decision, Record};
pub use settings::{Method, Settings};
pub use violation::{Bounded, Violation, violations};
