//! A chart: two axes and what is drawn between them.

use super::Colour;
use super::axis::Axis;
use super::series::{Series, Stroke};
use super::shape::Shape;

/// Values that must not be exceeded, drawn dashed.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bounds {
    pub label: String,
    pub values: Vec<f64>,
    /// One a value, as far as there are any; grey beyond.
    pub colours: Vec<Colour>,
}

impl Bounds {
    /// The colour of all of them, grey where they differ.
    pub fn common_colour(&self) -> Colour {
        match self.colours[..] {
            [first, ref rest @ ..] if rest.iter().all(|colour| *colour == first) => first,
            _ => Colour::Grey,
        }
    }
}

/// One panel of a figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    pub(super) title: String,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) series: Vec<Series>,
    pub(super) bounds: Vec<Bounds>,
    pub(super) divisions: Vec<f64>,
    pub(super) shapes: Vec<Shape>,
    pub(super) height: f64,
    pub(super) equal_scale: bool,
    pub(super) legend: bool,
    /// Entries of the legend that no series of this panel has.
    pub(super) entries: Vec<(String, Colour, Stroke)>,
}

impl Chart {
    /// An empty chart, 110 points high between its axes.
    pub fn new(x: Axis, y: Axis) -> Self {
        Self {
            title: String::new(),
            x,
            y,
            series: Vec::new(),
            bounds: Vec::new(),
            divisions: Vec::new(),
            shapes: Vec::new(),
            height: 110.0,
            equal_scale: false,
            legend: true,
            entries: Vec::new(),
        }
    }

    /// A line of text above the chart.
    #[must_use]
    pub fn title(mut self, title: &str) -> Self {
        self.title = title.into();
        self
    }

    /// Adds a series; series without a colour of their own take those of the palette in turn.
    #[must_use]
    pub fn series(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Adds horizontal bounds, dashed, with one entry in the legend.
    ///
    /// Bounds so far away that the data would shrink below a third of the height are not drawn;
    /// the legend then says that they lie beyond the axis.
    #[must_use]
    pub fn bounds(mut self, label: &str, values: &[f64]) -> Self {
        self.bounds.push(Bounds {
            label: label.into(),
            values: values.to_vec(),
            colours: Vec::new(),
        });
        self
    }

    /// The same with a colour for each: that of the series which it bounds.
    #[must_use]
    pub fn coloured_bounds(mut self, label: &str, bounds: &[(f64, Colour)]) -> Self {
        self.bounds.push(Bounds {
            label: label.into(),
            values: bounds.iter().map(|(value, _)| *value).collect(),
            colours: bounds.iter().map(|(_, colour)| *colour).collect(),
        });
        self
    }

    /// Thin vertical lines, for the boundaries of segments.
    #[must_use]
    pub fn divisions(mut self, x: &[f64]) -> Self {
        self.divisions.extend_from_slice(x);
        self
    }

    /// Adds a shape in the units of the axes.
    #[must_use]
    pub fn shape(mut self, shape: Shape) -> Self {
        self.shapes.push(shape);
        self
    }

    /// Height between the axes, in points.
    #[must_use]
    pub fn height(mut self, points: f64) -> Self {
        self.height = points;
        self
    }

    /// The same length for a unit along both axes: a drawing to scale.
    #[must_use]
    pub fn equal_scale(mut self) -> Self {
        self.equal_scale = true;
        self
    }

    /// An entry of the legend for lines that other panels have.
    #[must_use]
    pub fn entry(mut self, label: &str, colour: Colour, stroke: Stroke) -> Self {
        self.entries.push((label.into(), colour, stroke));
        self
    }

    /// No legend, where another panel has the same one.
    #[must_use]
    pub fn without_legend(mut self) -> Self {
        self.legend = false;
        self
    }
}
