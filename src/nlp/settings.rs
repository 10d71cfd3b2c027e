//! Settings of one solve.

use super::LinearSolver;
use std::time::Duration;

/// The value of a solver option given by name.
#[derive(Debug, Clone, PartialEq)]
pub enum OptionValue {
    /// A whole number.
    Integer(i32),
    /// A real number.
    Real(f64),
    /// A word.
    Text(String),
}

/// Settings of one solve. Each field says its default.
///
/// ```
/// use ffsm_ipopt::nlp::Settings;
///
/// let mut settings = Settings::default();
/// settings.tolerance = 1e-6;
/// settings.linear_solver = "mumps".into();
/// ```
#[non_exhaustive]
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Convergence tolerance of the scaled optimality conditions. Default 1e-9.
    pub tolerance: f64,
    /// Limit on the iterations of one solve. A refinement may solve on one mesh more than once: where a warm
    /// start fails within 100 of them, with a wider barrier (300 at most), then without multipliers.
    /// Default 500.
    pub max_iterations: u32,
    /// Limit on the wall time of all that is done with these settings: one solve, a refinement or a
    /// whole plan with its diagnosis. It is looked at after each iteration. Default `None`.
    pub time_limit: Option<Duration>,
    /// Linear solver. Default [`LinearSolver::Auto`].
    pub linear_solver: LinearSolver,
    /// Start from the multipliers of the starting iterate as well, with this barrier
    /// parameter. Default `None`: a cold start.
    pub warm_start: Option<f64>,
    /// Ipopt's own print level on standard output, 0 to 12. Default 0.
    pub print_level: u8,
    /// Ask Ipopt where its time went (a few file operations a solve). Default true.
    pub timing: bool,
    /// Any other Ipopt option, set last, so that it overrides the fields above.
    pub options: Vec<(String, OptionValue)>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            tolerance: 1e-9,
            max_iterations: 500,
            time_limit: None,
            linear_solver: LinearSolver::Auto,
            warm_start: None,
            print_level: 0,
            timing: true,
            options: Vec::new(),
        }
    }
}
