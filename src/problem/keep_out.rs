//! Pairs of solids that are kept apart along the path.

use crate::dynamics::{MOST_LENGTH, Placement};
use nalgebra::{Matrix3, Vector3};
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
    /// A ball swept along a line, as a link is.
    Capsule {
        /// Where the centre of the ball begins and ends, m.
        ends: [[f64; 3]; 2],
        /// Radius, m; 0 for a line.
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

impl Shape {
    /// The sphere whose sweep from the first centre to the second it is, with its radius, m; the
    /// centres of a sphere are the same. None of a box.
    pub fn swept_sphere(&self) -> Option<([[f64; 3]; 2], f64)> {
        match self {
            Self::Sphere { center, radius } => Some(([*center; 2], *radius)),
            Self::Capsule { ends, radius } => Some((*ends, *radius)),
            Self::Box { .. } => None,
        }
    }

    /// The eight corners of a box, m, that of least coordinates first and x changing fastest; none
    /// of other shapes.
    pub fn corners(&self) -> Vec<[f64; 3]> {
        let Self::Box {
            center,
            rotation,
            half,
        } = self
        else {
            return Vec::new();
        };
        let corner = |number: usize| {
            let sign = |axis: usize| if number >> axis & 1 == 0 { -1.0 } else { 1.0 };
            let from_center = Vector3::from_fn(|axis, _| sign(axis) * half[axis]);
            (Vector3::from(*center) + rotation * from_center).into()
        };
        (0..8).map(corner).collect()
    }

    /// The same in another frame, in which its own has the pose `placement`.
    pub fn placed(&self, placement: &Placement) -> Self {
        let moved = |point: [f64; 3]| {
            (placement.rotation * Vector3::from(point) + placement.translation).into()
        };
        match self {
            Self::Sphere { center, radius } => Self::Sphere {
                center: moved(*center),
                radius: *radius,
            },
            Self::Capsule { ends, radius } => Self::Capsule {
                ends: ends.map(moved),
                radius: *radius,
            },
            Self::Box {
                center,
                rotation,
                half,
            } => Self::Box {
                center: moved(*center),
                rotation: placement.rotation * rotation,
                half: *half,
            },
        }
    }

    /// Its key in the problem file where it stands first in a pair.
    pub(super) fn key(&self) -> &'static str {
        match self {
            Self::Sphere { .. } => "sphere",
            Self::Capsule { .. } => "capsule",
            Self::Box { .. } => "first",
        }
    }

    /// What is wrong with its numbers: key, what stands there, what was expected.
    pub(super) fn fault(&self) -> Option<(&'static str, String, &'static str)> {
        match self {
            Self::Sphere { center, radius } => finite("center", center).or(length(*radius)),
            Self::Capsule { ends, radius } => {
                let same = (ends[0] == ends[1])
                    .then(|| ("ends", "two equal points".into(), "two points apart"));
                let numbers = ends.as_flattened();
                finite("ends", numbers).or(same).or(length(*radius))
            }
            Self::Box {
                center,
                rotation,
                half,
            } => {
                let off = (rotation.transpose() * rotation - Matrix3::identity()).amax();
                let turned = (off.is_nan() || off > 1e-6)
                    .then(|| ("rotation", rotation.to_string(), "a rotation matrix"));
                let flat = half.iter().find(|h| !(**h <= MOST_LENGTH && **h > 0.0));
                let flat = flat.map(|h| ("half", h.to_string(), "finite lengths above zero, m"));
                finite("center", center).or(turned).or(flat)
            }
        }
    }
}

fn finite(key: &'static str, numbers: &[f64]) -> Option<(&'static str, String, &'static str)> {
    let number = numbers
        .iter()
        .find(|number| number.is_nan() || number.abs() > MOST_LENGTH)?;
    Some((key, number.to_string(), "finite numbers, at most 1e9 m"))
}

fn length(radius: f64) -> Option<(&'static str, String, &'static str)> {
    let expected = "a finite length, m, zero or above";
    let wrong = !(0.0..=MOST_LENGTH).contains(&radius);
    wrong.then(|| ("radius", radius.to_string(), expected))
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sphere { radius: 0.0, .. } => f.write_str("a point"),
            Self::Sphere { radius, .. } => write!(f, "a sphere of {} cm", centimetres(*radius)),
            Self::Capsule { ends, radius } => {
                let [a, b] = ends.map(Vector3::from);
                let (length, radius) = (centimetres((b - a).norm()), centimetres(*radius));
                write!(
                    f,
                    "a capsule around an axis of {length} cm, radius {radius} cm"
                )
            }
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

    /// A capsule in the body of joint `joint` (`None`: the base); ends of its axis and radius in m.
    pub fn capsule(joint: Option<usize>, ends: [[f64; 3]; 2], radius: f64) -> Self {
        let shape = Shape::Capsule { ends, radius };
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

    /// Whether it is a box.
    pub fn is_box(&self) -> bool {
        matches!(self.shape, Shape::Box { .. })
    }

    /// Whether it is a point or a line.
    pub(super) fn has_no_volume(&self) -> bool {
        matches!(
            self.shape,
            Shape::Sphere { radius: 0.0, .. } | Shape::Capsule { radius: 0.0, .. }
        )
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
