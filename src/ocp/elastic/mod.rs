//! Limits that give way at a price: finds which limits of a problem cannot hold.
//!
//! | file | does |
//! | --- | --- |
//! | `limits` | which bounds give way, and what the problem is without them |
//! | `problem` | the elastic problem as an [`Ocp`](super::Ocp) |
//! | `derivatives` | its derivatives from those of the problem inside |
//!
//! Derived in docs/algorithms.md#elastic-diagnosis.

mod derivatives;
mod limits;
mod problem;

pub use limits::{Elastic, LimitGroup, Limited};
