//! The paper's tables, figures and claims, computed again and set beside what was published.
//!
//! [`table2`] measures both methods, [`bounds`] shows why the published case has no solution,
//! [`figures`] draws figures 2 to 6, and [`document`] writes docs/reproduction.md from those runs:
//! no figure in it is typed by hand.

pub mod bounds;
pub mod document;
pub mod figures;
pub mod platform;
mod session;
pub mod table2;

pub use session::{ReproductionError, Run, Session, Step};

/// The shipped cases that have a solution, with the cost J* of their optimum.
///
/// As published the case has none (`config/table1.toml`). Both optima are known from independent
/// solutions, to the digits given here.
pub const CASES: [(&str, f64); 2] = [
    ("table1-relaxed", 0.4342434),
    ("table1-smooth", 0.435641534),
];
