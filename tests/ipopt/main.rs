//! The Ipopt wrapper against programmes with known answers, and against misuse.

#[path = "../allocations/mod.rs"]
mod allocations;
mod answers;
mod fallback;
mod helpers;
mod misuse;
mod options;
mod programmes;
mod stopping;
mod surroundings;
mod time_and_memory;
