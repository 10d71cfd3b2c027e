//! Robots described in URDF: what is understood, what is taken for granted, what is refused.

#[path = "../program/mod.rs"]
mod program;

mod as_written;
mod bodies;
mod collisions;
mod colours;
mod exported;
mod faults;
mod refused_files;
mod refused_joints;
mod refused_links;
mod refused_trees;
mod repair;
mod robots;
mod starter;
mod tasks;
mod understood;
