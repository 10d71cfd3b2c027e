//! Frames fixed in bodies.

use super::algebra::Algebra;

/// A frame fixed in the body of a joint, or in the base.
#[derive(Debug, Clone)]
pub struct Mount<Sp: Algebra> {
    pub(super) link: Option<usize>,
    pub(super) orientation: Sp::Orientation<f64>,
    pub(super) offset: Sp::Linear<f64>,
    /// Of the origin above the base's along the plane's normal, m; zero in space.
    pub(super) height: f64,
}
