//! The reduced dynamics against the unreduced ones of `verify`, against themselves in the plane
//! and in space, and against known answers.

#[path = "../problems/mod.rs"]
mod problems;
#[path = "../trees/mod.rs"]
mod trees;

mod base_motion;
mod bounds;
mod compared;
mod planes;
mod positions;
mod reduced;
