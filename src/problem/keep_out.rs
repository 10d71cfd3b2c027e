//! Pairs of solids that are kept apart along the path.

use nalgebra::Matrix3;
use std::fmt;

/// What a solid fills, in the frame of the body that carries it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// A ball.
    Sphere {
        /// Centre, m.
        center: [f64; 3],
        /// Radius, m; 0 for a point.
        radius: f64,
    },
    /// A box.
    Box {
        /// Centre, m.
        center: [f64; 3],
        /// Directions of its edges, the columns of a rotation matrix.
        rotation: Matrix3<f64>,
        /// Half of each edge, m.
        half: [f64; 3],
    },
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sphere { radius: 0.0, .. } => f.write_str("a point"),
            Self::Sphere { radius, .. } => write!(f, "a sphere of {} cm", centimetres(*radius)),
            Self::Box { half, .. } => {
                let [x, y, z] = half.map(|h| centimetres(2.0 * h));
                write!(f, "a box of {x} × {y} × {z} cm")
            }
        }
    }
}

/// To a micrometre.
fn centimetres(length: f64) -> f64 {
    (length * 1e6).round() / 1e4
}

/// A solid fixed in a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Solid {
    /// The joint whose body carries it; `None` for the base.
    pub joint: Option<usize>,
    /// What it fills.
    pub shape: Shape,
}

impl Solid {
    /// A sphere in the body of joint `joint` (`None`: the base); centre and radius in m.
    pub fn sphere(joint: Option<usize>, center: [f64; 3], radius: f64) -> Self {
        let shape = Shape::Sphere { center, radius };
        Self { joint, shape }
    }

    /// A box with edges along the axes of the body of joint `joint` (`None`: the base); centre and
    /// half of each edge in m.
    pub fn cuboid(joint: Option<usize>, center: [f64; 3], half: [f64; 3]) -> Self {
        let shape = Shape::Box {
            center,
            rotation: Matrix3::identity(),
            half,
        };
        Self { joint, shape }
    }

    pub(super) fn is_box(&self) -> bool {
        matches!(self.shape, Shape::Box { .. })
    }

    /// Whether it has no extent.
    pub(super) fn is_point(&self) -> bool {
        matches!(self.shape, Shape::Sphere { radius: 0.0, .. })
    }
}

/// One pair that is kept apart along the whole path.
#[derive(Debug, Clone, PartialEq)]
pub struct KeepOut {
    /// What a person calls it ("forearm off the bus").
    pub name: String,
    /// One solid.
    pub first: Solid,
    /// The other, on another body; one of the two at least is no box.
    pub second: Solid,
}
