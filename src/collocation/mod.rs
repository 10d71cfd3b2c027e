//! Legendre-Gauss-Radau collocation: points, weights, differentiation, interpolation, mesh.
//!
//! No physics here: everything is about polynomials on [−1, 1] and how segments tile the time
//! axis.

mod barycentric;
mod lgr;
mod mesh;

pub use barycentric::Barycentric;
pub use lgr::Rule;
pub use mesh::{Mesh, MeshError};
