//! The commands: what they print, where, and how they end.

#[path = "../program/mod.rs"]
mod program;

mod attitude;
mod book;
mod check;
mod endings;
mod export;
mod figures;
mod first_steps;
mod interruption;
mod judged;
mod output;
mod paper;
mod planners;
mod report;
mod saved;
mod schema;
mod settings;
mod surfaces;
mod usage;
