//! Our own direct solver for sparse symmetric indefinite systems: a multifrontal LDLᵀ.
//!
//! [`Symbolic`] is the analysis of a sparsity pattern, made once; [`Factors`] takes the values of
//! one matrix after another and solves with them, without allocating once it is warm. Pivots of
//! order one and two are chosen by size among the unknowns of a front and delayed to its parent
//! where none is large enough, so that the inertia is that of the matrix.

mod amalgamation;
mod dissection;
mod division;
mod factor;
mod graph;
mod lanes;
mod lists;
mod noise;
mod ordering;
mod pairs;
mod panel;
mod part;
mod pattern;
mod solve;
mod symbolic;
mod update;

pub use factor::{Factors, NotFinite};
pub use part::Inertia;
pub use pattern::{Pattern, PatternError};
pub use symbolic::Symbolic;
