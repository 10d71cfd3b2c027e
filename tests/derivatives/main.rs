//! Jacobian and Hessian of whole programmes against `num-dual`, an independent exact method, and
//! against their own sparsity pattern.

#[path = "../allocations/mod.rs"]
mod allocations;
#[path = "../problems/mod.rs"]
mod problems;
#[path = "../trees/mod.rs"]
mod trees;

mod border;
mod checks;
mod explicit_time;
mod free_breakpoints;
mod functions;
mod in_space;
mod in_the_plane;
mod kept;
mod peaks;
mod problem_kinds;
mod reference;
mod rows;
mod structure;
