//! Goals for the end effector, and free final time.

#[path = "../problems/mod.rs"]
mod problems;
#[path = "../trees/mod.rs"]
mod trees;

mod fastest;
mod goals;
mod turned_start;
mod two_link;
mod way_points;
