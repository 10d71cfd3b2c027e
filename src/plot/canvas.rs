//! What a figure consists of, element by element, for the SVG and the PNG alike.

use super::{Colour, Stroke};

/// Where a text's anchor lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// Which way a text runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Direction {
    Right,
    Up,
}

/// What elements belong to, for scripts that show and hide it. Numbers are those of
/// [`Chart::entry_of_series`](super::Chart).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// What the entry of the legend with this number stands for.
    Curve(usize),
    /// That entry itself.
    Entry(usize),
    /// Boundaries of segments.
    Divisions,
    /// Ticks with their labels and the lines of the grid.
    Ticks,
}

/// One element. Lengths are points, y points down.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Element {
    /// Begins a window (x, y, width, height) that nothing is drawn outside of; coordinates stay
    /// those of the document. Windows do not nest.
    Clip([f64; 4]),
    /// Ends the window.
    Unclip,
    /// Begins what belongs together. Groups do not nest, and nothing is drawn for them.
    Group(Part),
    /// Ends it.
    Ungroup,
    /// An open line of two points and more.
    Path {
        points: Vec<[f64; 2]>,
        colour: Colour,
        width: f64,
        stroke: Stroke,
    },
    /// A closed outline, with its width, filled where a colour is given, with its opacity.
    Polygon {
        corners: Vec<[f64; 2]>,
        outline: Option<(Colour, f64)>,
        fill: Option<(Colour, f64)>,
    },
    /// A circle, filled, or white with an outline.
    Circle {
        centre: [f64; 2],
        radius: f64,
        outline: Colour,
        fill: Option<Colour>,
    },
    /// A text on one line, the anchor on its baseline.
    Text {
        at: [f64; 2],
        anchor: Anchor,
        direction: Direction,
        size: f64,
        text: String,
    },
}

/// Width of a circle's outline, points.
pub(super) const RING: f64 = 0.7;

/// Lengths of dashes and gaps in turn, points.
pub(super) fn dashes(stroke: Stroke) -> &'static [f32] {
    match stroke {
        Stroke::Solid | Stroke::None => &[],
        Stroke::Dashed => &[5.0, 2.5],
        Stroke::Dotted => &[1.2, 1.8],
    }
}

/// Elements in the order in which they are drawn, the last on top.
#[derive(Debug, Clone, Default)]
pub(super) struct Canvas {
    pub elements: Vec<Element>,
}

impl Canvas {
    /// Begins a window.
    pub fn clip(&mut self, window: [f64; 4]) {
        self.elements.push(Element::Clip(window));
    }

    /// Ends the window.
    pub fn unclip(&mut self) {
        self.elements.push(Element::Unclip);
    }

    /// Draws what belongs to `part`.
    pub fn group(&mut self, part: Part, draw: impl FnOnce(&mut Self)) {
        self.elements.push(Element::Group(part));
        draw(self);
        self.elements.push(Element::Ungroup);
    }

    /// An open line.
    pub fn path(&mut self, points: &[[f64; 2]], colour: Colour, width: f64, stroke: Stroke) {
        if points.len() < 2 || stroke == Stroke::None {
            return;
        }
        self.elements.push(Element::Path {
            points: points.to_vec(),
            colour,
            width,
            stroke,
        });
    }

    /// A closed outline, filled where a colour is given.
    pub fn polygon(
        &mut self,
        corners: &[[f64; 2]],
        outline: Option<(Colour, f64)>,
        fill: Option<(Colour, f64)>,
    ) {
        self.elements.push(Element::Polygon {
            corners: corners.to_vec(),
            outline,
            fill,
        });
    }

    /// A circle, filled, or white with an outline.
    pub fn circle(&mut self, centre: [f64; 2], radius: f64, outline: Colour, fill: Option<Colour>) {
        self.elements.push(Element::Circle {
            centre,
            radius,
            outline,
            fill,
        });
    }

    /// A text on one line, its baseline at `y`.
    pub fn text(&mut self, at: [f64; 2], anchor: Anchor, size: f64, text: &str) {
        self.write(at, anchor, Direction::Right, size, text);
    }

    /// A text from bottom to top, centred at `y`, its baseline at `x`.
    pub fn upward_text(&mut self, at: [f64; 2], size: f64, text: &str) {
        self.write(at, Anchor::Middle, Direction::Up, size, text);
    }

    fn write(&mut self, at: [f64; 2], anchor: Anchor, direction: Direction, size: f64, text: &str) {
        self.elements.push(Element::Text {
            at,
            anchor,
            direction,
            size,
            text: text.into(),
        });
    }
}
