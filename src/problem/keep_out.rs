//! Pairs of bodies that are kept apart along the path.

/// A sphere fixed in a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Sphere {
    /// The joint whose body carries it; `None` for the base.
    pub joint: Option<usize>,
    /// Centre in the body's frame, m.
    pub center: [f64; 3],
    /// Radius, m; 0 for a point.
    pub radius: f64,
}

/// What a sphere is kept out of.
#[derive(Debug, Clone, PartialEq)]
pub enum Obstacle {
    /// Another sphere, on the base or on another body.
    Sphere(Sphere),
    /// A box with edges along the base frame's axes.
    Box {
        /// Centre in the base frame, m.
        center: [f64; 3],
        /// Half of each edge, m.
        half: [f64; 3],
    },
}

/// One pair that is kept apart along the whole path.
#[derive(Debug, Clone, PartialEq)]
pub struct KeepOut {
    /// What a person calls it ("forearm off the bus").
    pub name: String,
    /// The sphere.
    pub sphere: Sphere,
    /// What it is kept out of.
    pub from: Obstacle,
}
