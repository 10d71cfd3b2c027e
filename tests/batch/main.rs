//! Batches: the same rows however they are planned, and none lost whatever ends the program.

#[path = "../program/mod.rs"]
mod program;

mod bad_input;
mod endings;
mod isolation;
mod report;
mod rows;
mod same_rows;
mod varied;
