//! Shapes in the units of the axes, for drawings to scale.

use super::{Colour, Stroke};

/// A shape in the units of the axes.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// A closed outline, filled where a colour is given.
    Polygon {
        /// Corners (x, y).
        corners: Vec<[f64; 2]>,
        /// Colour of the outline.
        outline: Colour,
        /// Colour of the area and its opacity from 0 to 1.
        fill: Option<(Colour, f64)>,
    },
    /// An open path.
    Path {
        /// Points (x, y).
        points: Vec<[f64; 2]>,
        /// Colour of the line.
        colour: Colour,
        /// Width of the line in points.
        width: f64,
        /// How it is drawn.
        stroke: Stroke,
    },
    /// A filled circle with an outline.
    Disc {
        /// Centre (x, y).
        centre: [f64; 2],
        /// Radius in points, whatever the axes.
        radius: f64,
        /// Colour of the area.
        fill: Colour,
    },
    /// A short text centred at a place.
    Label {
        /// Centre (x, y).
        at: [f64; 2],
        /// The text.
        text: String,
    },
}

impl Shape {
    /// Points that the axes must hold.
    pub(super) fn extent(&self) -> &[[f64; 2]] {
        match self {
            Self::Polygon { corners, .. } => corners,
            Self::Path { points, .. } => points,
            Self::Disc { centre: at, .. } | Self::Label { at, .. } => std::slice::from_ref(at),
        }
    }
}
