//! The plane and three-dimensional space: their vector algebra, and the base attitude in each.

use super::attitude::{Attitude, PlanarAngle, SpatialAttitude};

pub use super::algebra::{Algebra, Planar, Spatial, Symmetric, Vector};

/// Where bodies move: [`Planar`] or [`Spatial`].
pub trait Space: Algebra {
    /// How the base's orientation is described.
    type Attitude: Attitude<Self>;
}

impl Space for Planar {
    type Attitude = PlanarAngle;
}

impl Space for Spatial {
    type Attitude = SpatialAttitude;
}
