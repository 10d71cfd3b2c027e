//! The ground platform against motions in closed form and against the plan it plays.

#[path = "../problems/mod.rs"]
mod problems;
#[path = "../trees/mod.rs"]
mod trees;

mod control;
mod fit;
mod forces;
mod laws;
mod platforms;
mod runs;
