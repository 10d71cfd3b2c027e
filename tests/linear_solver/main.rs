//! The multifrontal linear solver inside Ipopt where systems are singular or badly scaled, against
//! MUMPS and against the same problems without what makes them singular.

mod dependent;
#[path = "../problems/mod.rs"]
mod problems;
mod random;
mod tasks;
#[path = "../trees/mod.rs"]
mod trees;
