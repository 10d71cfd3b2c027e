//! What a chart shows: lines, steps, points and bands.

use super::Colour;

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stroke {
    /// A thin line without gaps.
    Solid,
    /// Long dashes; by custom those of bounds.
    Dashed,
    /// Dots.
    Dotted,
    /// No line, the markers alone.
    None,
}

/// A mark at every point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Marker {
    /// A filled circle.
    Disc,
    /// An empty circle.
    Ring,
    /// A filled square.
    Square,
    /// A filled triangle.
    Triangle,
    /// A filled diamond.
    Diamond,
    /// A diagonal cross.
    Cross,
}

/// The points of a series.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Points {
    /// (x, y)
    Line(Vec<[f64; 2]>),
    /// (x, lower, upper)
    Band(Vec<[f64; 3]>),
}

/// One curve of a chart with its entry in the legend.
///
/// A value that is not finite, or not positive on a logarithmic axis, leaves a gap.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    pub(super) label: String,
    /// Where it has another name than its label.
    pub(super) name: Option<String>,
    pub(super) points: Points,
    pub(super) colour: Option<Colour>,
    pub(super) stroke: Stroke,
    pub(super) width: f64,
    pub(super) marker: Option<Marker>,
}

impl Series {
    fn new(label: &str, points: Points) -> Self {
        Self {
            label: label.into(),
            name: None,
            points,
            colour: None,
            stroke: Stroke::Solid,
            width: 1.1,
            marker: None,
        }
    }

    /// A line through the points; an empty label leaves it out of the legend.
    ///
    /// # Panics
    /// Where `x` and `y` differ in length.
    pub fn line(label: &str, x: &[f64], y: &[f64]) -> Self {
        assert_eq!(
            x.len(),
            y.len(),
            "series {label:?}: x and y differ in length"
        );
        let points = x.iter().zip(y).map(|(x, y)| [*x, *y]).collect();
        Self::new(label, Points::Line(points))
    }

    /// Markers without a line.
    ///
    /// # Panics
    /// Where `x` and `y` differ in length.
    pub fn scatter(label: &str, x: &[f64], y: &[f64], marker: Marker) -> Self {
        Self::line(label, x, y).stroke(Stroke::None).marker(marker)
    }

    /// One level between each two neighbouring edges.
    ///
    /// # Panics
    /// Where there is not one edge more than there are levels.
    pub fn steps(label: &str, edges: &[f64], levels: &[f64]) -> Self {
        assert_eq!(
            edges.len(),
            levels.len() + 1,
            "series {label:?}: expected one edge more than levels"
        );
        let corner = |(pair, y): (&[f64], &f64)| [[pair[0], *y], [pair[1], *y]];
        let points = edges.windows(2).zip(levels).flat_map(corner).collect();
        Self::new(label, Points::Line(points))
    }

    /// The area between `lower` and `upper`, for the spread of repeats.
    ///
    /// # Panics
    /// Where the slices differ in length.
    pub fn band(label: &str, x: &[f64], lower: &[f64], upper: &[f64]) -> Self {
        assert!(
            x.len() == lower.len() && x.len() == upper.len(),
            "series {label:?}: x, lower and upper differ in length"
        );
        let points = (0..x.len()).map(|k| [x[k], lower[k], upper[k]]).collect();
        Self::new(label, Points::Band(points))
    }

    /// What [`Contents`](super::Contents) call it, its label unless said.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        self.name = Some(name.into());
        self
    }

    /// This colour instead of the next of the palette.
    #[must_use]
    pub fn colour(mut self, colour: Colour) -> Self {
        self.colour = Some(colour);
        self
    }

    /// Solid unless said.
    #[must_use]
    pub fn stroke(mut self, stroke: Stroke) -> Self {
        self.stroke = stroke;
        self
    }

    /// Width of the line in points, 1.1 unless said.
    #[must_use]
    pub fn width(mut self, points: f64) -> Self {
        self.width = points;
        self
    }

    /// A mark at every point.
    #[must_use]
    pub fn marker(mut self, marker: Marker) -> Self {
        self.marker = Some(marker);
        self
    }
}
