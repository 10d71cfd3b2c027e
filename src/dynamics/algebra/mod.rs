//! Vector algebra of rigid bodies, written once for the plane and for three-dimensional space.
//!
//! | file | holds |
//! | --- | --- |
//! | `vector` | a vector with components of any number type |
//! | `rules` | what the plane and space have to provide: rotations, cross products, inertia |
//! | `planar`, `spatial` | the plane and space |
//! | `motion_force` | motions and forces of rigid bodies, each the dual of the other |
//! | `body_inertia`, `composite_inertia` | the map from motions to forces: mass of one body, of several |
//! | `coriolis`, `angular_map` | how a change of the velocity changes forces |
//!
//! Names and signs follow R. Featherstone, "Rigid Body Dynamics Algorithms",
//! doi:10.1007/978-1-4899-7560-7, chapter 2, and Pinocchio.

mod angular_map;
mod body_inertia;
mod composite_inertia;
mod coriolis;
mod motion_force;
mod planar;
mod rules;
mod spatial;
mod symmetric;
mod vector;

pub(super) use angular_map::AngularMap;
pub(super) use body_inertia::BodyInertia;
pub(super) use composite_inertia::CompositeInertia;
pub(super) use coriolis::Coriolis;
pub(super) use motion_force::{Force, Motion};
pub use planar::Planar;
pub use rules::Algebra;
pub use spatial::Spatial;
pub use symmetric::Symmetric;
pub use vector::Vector;
pub(super) use vector::plus_inner;
