//! Robots described in URDF: what is understood, what is taken for granted, what is refused.

#[path = "../program/mod.rs"]
mod program;

mod collisions;
mod exported;
mod refused_files;
mod refused_joints;
mod refused_links;
mod refused_trees;
mod robots;
mod understood;
