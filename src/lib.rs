#![doc = include_str!("../README.md")]

pub mod autodiff;
pub mod collocation;
pub mod config;
mod digits;
pub mod dynamics;
pub mod integrate;
mod largest;
pub mod nlp;
pub mod ocp;
pub mod parallel;
pub mod planner;
mod printable;
pub mod problem;
pub mod refine;
pub mod report;
pub mod simulate;
pub mod solution;
pub mod study;
pub mod system;
pub mod transcription;
pub mod verify;

// Not part of the library's interface: what the program and its tests need to reach.
#[doc(hidden)]
#[allow(rustdoc::invalid_html_tags)] // help texts name places by <problem name>
pub mod cli;
#[doc(hidden)]
pub mod plot;
#[doc(hidden)]
pub mod reproduction;

/// The small dense algebra that models are described with.
pub use nalgebra;
