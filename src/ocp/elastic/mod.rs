//! Limits that give way at a price: finds which limits of a problem cannot hold.
//!
//! | file | does |
//! | --- | --- |
//! | `amounts` | by how much a trajectory exceeds what gives way |
//! | `limits` | which bounds give way, and what the problem is without them |
//! | `problem` | the elastic problem as an [`Ocp`](super::Ocp) |
//! | `derivatives` | its derivatives from those of the problem inside |
//!
//! Derived in docs/algorithms.md#elastic-diagnosis.

mod amounts;
mod derivatives;
mod limits;
mod problem;

pub use limits::{Elastic, LimitGroup, Limited};
