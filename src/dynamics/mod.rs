//! Free-floating multibody dynamics by momentum conservation, equations (1) to (6).
//!
//! A [`Model`] is an immutable tree of rigid bodies on a floating base. Compiled to a
//! [`Tree`] in the plane or in space, it is evaluated with any [`Scalar`](crate::autodiff::Scalar)
//! into a mutable [`Data`]; one algorithm a file:
//!
//! | file | computes |
//! | --- | --- |
//! | `model`, `joint`, `inertia`, `placement`, `mount` | the robot as its maker describes it |
//! | `planarity`, `massless` | whether it stays in a plane, and whether every joint moves a mass |
//! | `compile`, `model_tree`, `tree` | from a model to what the recursions read |
//! | `data`, `storage`, `unrolled` | scratch, its room, loops over few joints unrolled |
//! | `space`, `algebra` | vectors, motions, forces and inertia in the plane and in space |
//! | `kinematics` | poses of all bodies, eq. (1) |
//! | `momentum` | composite rigid bodies, momentum of unit joint rates, base rate, eq. (2), (5) |
//! | `mass_center` | derivatives of the system's mass centre by the joint positions |
//! | `mass_matrix` | the reduced inertia matrix H, eq. (6) |
//! | `bias` | the reduced Coriolis force Cθ̇ by one recursive Newton-Euler pass, eq. (6) |
//! | `attitude` | the rate map of the base attitude |
//! | `ldl` | LDLᵀ of H and of other small matrices |
//! | `mounted_frames`, `relative_frames` | frames fixed in bodies, the end effector's among them, and one body's as seen from another |
//! | `mobility`, `reach` | bounds on H and on the end effector's distance, at all positions |
//! | `sensitivity` | first and second derivatives of the free motion, by structure |
//!
//! All vectors are in the axes of the base body, so that nothing depends on the base attitude.

mod algebra;
pub mod attitude;
mod bias;
mod compile;
mod data;
mod inertia;
mod joint;
mod kinematics;
mod ldl;
mod mass_center;
mod mass_matrix;
mod massless;
mod mobility;
mod model;
mod model_tree;
mod momentum;
mod mount;
mod mounted_frames;
mod placement;
mod planarity;
mod reach;
mod relative_frames;
mod sensitivity;
pub mod space;
mod storage;
mod tree;
mod unrolled;

/// Largest magnitude of a length in a robot's description, m: farther than the moon.
pub const MOST_LENGTH: f64 = 1e9;

pub use data::Data;
pub use inertia::{Inertia, InertiaError, Quantity};
pub use joint::{Body, EndEffector, Joint, JointKind, JointLimits};
pub use ldl::Ldl;
pub use model::{Model, ModelError};
pub use mount::Mount;
pub use placement::Placement;
pub use planarity::{Deviation, Plane};
pub use reach::Ball;
pub use sensitivity::Sensitivity;
pub use storage::{Heap, InPlace, Storage};
pub use tree::Tree;
