//! A direct solver for sparse symmetric indefinite systems: a multifrontal LDLᵀ factorisation.
//!
//! [`Symbolic`] is the analysis of a sparsity pattern, made once. [`Factors`] factorises matrices with
//! that pattern one after another and solves with them, without allocating once it is warm. Pivots of
//! order one and two are chosen by size among the fully summed unknowns of a front, and delayed to
//! its parent where none is large enough; so the inertia is exact.
//!
//! | file | does |
//! | --- | --- |
//! | `pattern` | the sparsity of the lower triangle |
//! | `matching` | a variable for each multiplier, as a pivot of order two |
//! | `graph`, `lists` | the adjacency graph that is ordered, and lists for it |
//! | `dissection` | separators along the time axis |
//! | `ordering` | minimum degree and the assembly tree |
//! | `amalgamation` | small fronts merged with their parents |
//! | `partition` | the tree in subtrees that can be factorised at the same time |
//! | `symbolic` | all of the analysis |
//! | `factor` | all of the factorisation |
//! | `subtree` | the fronts of one subtree, assembled and eliminated |
//! | `panel` | threshold pivoting in one front |
//! | `scaling` | columns brought to one size |
//! | `zero_pivots` | which columns are rounding error |
//! | `growth` | a scaling where delayed pivots make the factors grow |
//! | `update`, `simd` | dense kernels on vectors |
//! | `solve` | forward and backward substitution |
//!
//! Derived in docs/algorithms.md#kkt-systems.

mod amalgamation;
mod dissection;
mod factor;
mod graph;
mod growth;
mod lists;
mod matching;
mod ordering;
mod panel;
mod partition;
mod pattern;
mod scaling;
mod simd;
mod solve;
mod subtree;
mod symbolic;
mod update;
mod zero_pivots;

pub use factor::{Factors, NotFinite};
pub(crate) use growth::Growth;
pub use pattern::{Pattern, PatternError};
pub use subtree::Inertia;
pub use symbolic::Symbolic;
