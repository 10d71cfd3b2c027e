//! The paper's tables, figures and claims, computed again and set beside what was published.
//!
//! | item | does |
//! | --- | --- |
//! | [`table2`] | measures both methods |
//! | [`bounds`] | shows why the published case has no solution |
//! | [`figures`] | draws figures 2 to 6 |
//! | [`compared`] | plans by every planner |
//! | [`TradeOff`] | sweeps the weights on the base |
//! | [`platform`] | asks what explains the measurements of Section IV.B |
//! | [`document`] | writes docs/reproduction.md from those runs: no figure in it is typed by hand |

pub mod bounds;
mod comparison;
pub mod document;
pub mod figures;
pub mod platform;
mod session;
pub mod table2;
mod trade_off;

use crate::planner::Method;
use crate::refine;

pub use comparison::{Compared, compared};
pub use session::{ReproductionError, Run, Session, Step};
pub use trade_off::TradeOff;

/// The method of the paper.
pub const A_RPM: Method = Method::Collocation(refine::Method::Adaptive);

/// The shipped case without the published bounds on the base attitude.
pub const RELAXED: &str = "table1-relaxed";

/// The shipped case with the published bounds, on a base that is harder to turn.
pub const HEAVY: &str = "table1-heavy-base";

/// The shipped cases that have a solution, with the cost J* of their optimum.
///
/// As published the case has none (`config/table1.toml`). Both optima are known from independent
/// solutions, to the digits given here.
pub const CASES: [(&str, f64); 2] = [(RELAXED, 0.4342434), ("table1-smooth", 0.435641534)];
