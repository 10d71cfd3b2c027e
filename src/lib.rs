#![doc = include_str!("../README.md")]

pub mod autodiff;
pub mod cli;
pub mod collocation;
pub mod config;
pub mod dynamics;
pub mod integrate;
mod largest;
pub mod nlp;
pub mod ocp;
pub mod parallel;
pub mod planner;
pub mod plot;
pub mod problem;
pub mod refine;
pub mod report;
pub mod reproduction;
pub mod simulate;
pub mod solution;
pub mod study;
pub mod system;
pub mod transcription;
pub mod verify;

/// The small dense algebra that models are described with.
pub use nalgebra;
