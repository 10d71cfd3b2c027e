//! Bad input ends with status 2 and one line that names file, line, key and what was expected.

#[path = "../program/mod.rs"]
mod program;

mod attitude;
mod command_line;
mod complaints;
mod files;
mod hostile;
mod impossible;
mod keys;
mod limits;
mod numbers;
mod robots;
mod way_points;
