//! A figure: panels in columns.

use super::canvas::Canvas;
use super::chart::Chart;
use super::contents::Contents;
use super::draw::Layout;
use super::raster::{PlotError, png};
use super::svg::{Groups, svg};

/// Width of a figure on a two-column page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Width {
    /// One column, 252 points (89 mm).
    Column,
    /// Both columns, 516 points (182 mm).
    Page,
}

impl Width {
    fn points(self) -> f64 {
        match self {
            Self::Column => 252.0,
            Self::Page => 516.0,
        }
    }
}

/// Panels side by side or below each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    description: String,
    width: Width,
    columns: usize,
    panels: Vec<Chart>,
}

/// Between rows of panels, points.
const BETWEEN: f64 = 7.0;

impl Figure {
    /// An empty figure; the description is for those who cannot see it.
    pub fn new(description: &str, width: Width) -> Self {
        Self {
            description: description.into(),
            width,
            columns: 1,
            panels: Vec::new(),
        }
    }

    /// Panels side by side, 1 unless said.
    #[must_use]
    pub fn columns(mut self, columns: usize) -> Self {
        self.columns = columns.max(1);
        self
    }

    /// Adds a panel, row by row from the left.
    #[must_use]
    pub fn panel(mut self, chart: Chart) -> Self {
        self.panels.push(chart);
        self
    }

    /// The figure as an SVG document.
    pub fn svg(&self) -> String {
        let (canvas, height) = self.drawn();
        let size = [self.width.points(), height];
        svg(&canvas, &self.description, size, Groups::Left)
    }

    /// The same for a page with a script: what an entry of the legend stands for is a group with
    /// the attribute `data-curve`, the entry one with `data-entry`, both its number, and the
    /// boundaries of segments are one with `data-divisions`.
    pub fn svg_with_groups(&self) -> String {
        let (canvas, height) = self.drawn();
        let size = [self.width.points(), height];
        svg(&canvas, &self.description, size, Groups::Told)
    }

    /// What every panel shows, as numbers.
    pub fn contents(&self) -> Vec<Contents<'_>> {
        self.panels.iter().map(Contents::of).collect()
    }

    /// The figure as PNG, 288 pixels an inch.
    ///
    /// # Errors
    /// [`PlotError`] for one that is empty or too large to draw.
    pub fn png(&self) -> Result<Vec<u8>, PlotError> {
        let (canvas, height) = self.drawn();
        png(&canvas, self.width.points(), height)
    }

    /// Everything that is drawn, and the height, points.
    fn drawn(&self) -> (Canvas, f64) {
        let mut canvas = Canvas::default();
        let height = self.place(|layout, corner| layout.draw(&mut canvas, corner));
        (canvas, height)
    }

    /// Where the frame of every panel lies, for what is laid over the figure.
    pub fn frames(&self) -> Vec<Frame> {
        let width = self.width.points();
        let mut frames = Vec::with_capacity(self.panels.len());
        let total = self.place(|layout, [left, top]| {
            frames.push(Frame {
                left: left / width,
                top,
                width: layout.width() / width,
                height: layout.height(),
                x: layout.x_range(),
                y: layout.y_range(),
            });
        });
        for frame in &mut frames {
            frame.top /= total;
            frame.height /= total;
        }
        frames
    }

    /// Calls `each` with every panel and the corner of its frame; the height of the figure is
    /// returned, points.
    fn place(&self, mut each: impl FnMut(&Layout<'_>, [f64; 2])) -> f64 {
        let cell = self.width.points() / self.columns as f64;
        // Frames below each other are aligned.
        let left = |column: usize| {
            self.panels
                .iter()
                .skip(column)
                .step_by(self.columns)
                .map(Chart::left_margin)
                .fold(0.0, f64::max)
        };
        let lefts: Vec<f64> = (0..self.columns).map(left).collect();
        let mut top = 2.0;
        for row in self.panels.chunks(self.columns) {
            let layouts: Vec<Layout<'_>> = row
                .iter()
                .zip(&lefts)
                .map(|(chart, left)| Layout::new(chart, cell - left - 10.0))
                .collect();
            let margins: Vec<_> = layouts.iter().map(Layout::margins).collect();
            let above = margins.iter().map(|m| m.top).fold(0.0, f64::max);
            for (column, layout) in layouts.iter().enumerate() {
                each(
                    layout,
                    [cell * column as f64 + lefts[column] + 1.0, top + above],
                );
            }
            let below = layouts
                .iter()
                .zip(&margins)
                .map(|(layout, m)| layout.height() + m.bottom)
                .fold(0.0, f64::max);
            top += above + below + BETWEEN;
        }
        top
    }
}

/// The frame of a panel, in parts of the figure's width and height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Of its left side from that of the figure.
    pub left: f64,
    /// Of its upper side from that of the figure.
    pub top: f64,
    /// Its width.
    pub width: f64,
    /// Its height.
    pub height: f64,
    /// What the x axis reaches from and to.
    pub x: [f64; 2],
    /// What the y axis reaches from and to.
    pub y: [f64; 2],
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::{Axis, Colour, Marker, Series, Shape};

    fn figure() -> Figure {
        let t: Vec<f64> = (0..=100).map(|k| 0.2 * f64::from(k)).collect();
        let of = |f: fn(f64) -> f64| t.iter().map(|t| f(*t)).collect::<Vec<f64>>();
        let swing = Chart::new(Axis::linear("Time (s)"), Axis::linear("Angle (deg)"))
            .title("(a) Joint angles")
            .series(Series::line("θ₁", &t, &of(|t| 60.0 * t.sin())))
            .series(Series::line("θ₂", &t, &of(|t| 3.0 * t)))
            .bounds("limit ±90°", &[-90.0, 90.0])
            .bounds("limit ±5000°", &[5000.0])
            .divisions(&[5.0, 10.0]);
        let errors = Chart::new(Axis::linear("Time (s)"), Axis::log("Error"))
            .title("(b) Error")
            .series(Series::steps("η", &[0.0, 5.0, 20.0], &[1e-4, 3e-7]))
            .series(Series::scatter("θ₁", &t, &of(|t| 1e-6 * t), Marker::Ring))
            .bounds("tolerance", &[1e-5]);
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let scale = Chart::new(Axis::linear("x (m)"), Axis::linear("y (m)"))
            .equal_scale()
            .shape(Shape::Polygon {
                corners: square.to_vec(),
                outline: Colour::Black,
                fill: None,
            });
        Figure::new("A test", Width::Page)
            .columns(2)
            .panel(swing)
            .panel(errors)
            .panel(scale)
    }

    #[test]
    fn a_figure_is_whole_and_the_same_every_time() {
        let svg = figure().svg();
        assert_eq!(svg, figure().svg());
        for part in [
            "Time (s)",
            "θ₂",
            "limit ±90°",
            "limit ±5000° (beyond the axis)",
            "10⁻⁵",
            "−50",
            "stroke-dasharray=\"5 2.5\"",
            "<title>A test</title>",
        ] {
            assert!(svg.contains(part), "{part}");
        }
        // The far bound is left out: two bounds and a tolerance, and their three samples.
        let dashed = svg.matches("stroke-dasharray=\"5 2.5\"").count();
        assert_eq!(dashed, 3 + 3);
        let picture = figure().png().unwrap();
        assert_eq!(picture, figure().png().unwrap());
        assert_eq!(picture[16..20], 2064_u32.to_be_bytes());
    }

    #[test]
    fn frames_are_where_they_are_drawn() {
        let figure = figure();
        let svg = figure.svg();
        let frames = figure.frames();
        let view = svg.split("viewBox=\"0 0 ").nth(1).unwrap();
        let mut size = view.split(['"', ' ']).map(|v| v.parse::<f64>().unwrap());
        let [width, height] = [size.next().unwrap(), size.next().unwrap()];
        // Nothing is drawn outside of the frame: it is a window.
        let windows: Vec<[f64; 4]> = svg
            .split("<svg x=\"")
            .skip(1)
            .map(|window| {
                let mut values = window.split('"').step_by(2);
                [(); 4].map(|()| values.next().unwrap().parse().unwrap())
            })
            .collect();
        assert_eq!((frames.len(), windows.len()), (3, 3));
        for (frame, window) in frames.iter().zip(&windows) {
            let found = [
                frame.left * width,
                frame.top * height,
                frame.width * width,
                frame.height * height,
            ];
            let gap = found.iter().zip(window).map(|(a, b)| (a - b).abs());
            assert!(gap.fold(0.0, f64::max) < 0.02, "{found:?}, {window:?}");
        }
        assert_eq!(frames[0].x, [0.0, 20.0]);
        assert!(frames[0].y[0] < frames[0].y[1]);
    }

    #[test]
    fn a_drawing_is_to_scale() {
        let svg = figure().svg();
        let outline = svg
            .lines()
            .rfind(|line| line.ends_with("stroke-width=\"0.7\" stroke-linejoin=\"round\"/>"))
            .unwrap();
        let data = outline.split('"').nth(1).unwrap();
        let corners: Vec<[f64; 2]> = data[1..data.len() - 1]
            .split('L')
            .map(|pair| {
                let mut values = pair.split(' ').map(|v| v.parse::<f64>().unwrap());
                [values.next().unwrap(), values.next().unwrap()]
            })
            .collect();
        let side = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        let [wide, high] = [side(corners[0], corners[1]), side(corners[1], corners[2])];
        assert!(
            wide > 20.0 && (wide - high).abs() < 0.03,
            "{wide} by {high}"
        );
    }
}
