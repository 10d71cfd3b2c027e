//! Radau transcription: an optimal control problem on a mesh becomes a sparse programme,
//! eq. (22) to (27).
//!
//! Derived in docs/algorithms.md#transcription.

mod discretization;
mod evaluation;
mod grid;
mod hessian;
mod jacobian;
mod layout;
mod names;
mod node_derivatives;
mod objective;
mod pattern_check;
mod patterns;
mod points;
mod program;
mod quadrature;
mod ranges;
mod scales;
mod structure;
mod triplets;
mod way_point;

pub use discretization::Discretization;
pub use layout::{Layout, Row};
pub use patterns::Patterns;
pub use program::Transcription;
pub use quadrature::integrals;
pub use ranges::Ranges;
pub use scales::Scales;
pub use structure::{FixedControl, FixedRow, Knot, SmoothState, Structure};
