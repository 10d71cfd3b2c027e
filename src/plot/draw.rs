//! A chart on the canvas.

use super::canvas::{Anchor, Canvas, Part};
use super::legend::Legend;
use super::marks::{BAND, mark};
use super::ruler::{Ruler, Scale, Tick};
use super::series::Points;
use super::text::text_width;
use super::{Chart, Colour, Series, Shape, Stroke};

/// Size of tick labels, points.
const TICK: f64 = 7.0;
/// Size of axis labels and titles, points.
const LABEL: f64 = 7.5;
const TITLE: f64 = 8.0;
/// Part of the height that data keep when far bounds are drawn as well.
const KEPT: f64 = 1.0 / 3.0;

/// Room a chart needs above and below its frame, points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Margins {
    pub top: f64,
    pub bottom: f64,
}

/// A chart with its ranges and legend for a given width between the axes.
pub(super) struct Layout<'a> {
    chart: &'a Chart,
    x: Ruler,
    y: Ruler,
    width: f64,
    legend: Legend,
}

impl Chart {
    /// The colour of every series.
    pub(super) fn colours(&self) -> Vec<Colour> {
        let mut next = 0;
        let mut colour = |series: &Series| {
            series.colour.unwrap_or_else(|| {
                next += 1;
                Colour::of_series(next - 1)
            })
        };
        self.series.iter().map(&mut colour).collect()
    }

    /// The number of the entry in the legend that series `i` belongs to: its own, or without a label
    /// that of the last series before it that has one.
    pub(super) fn entry_of_series(&self, i: usize) -> usize {
        let labelled = |k: &usize| !self.series[*k].label.is_empty();
        (0..=i).rev().find(labelled).unwrap_or(i)
    }

    /// The number of the entry of the bounds `j`.
    pub(super) fn entry_of_bounds(&self, j: usize) -> usize {
        self.series.len() + j
    }

    fn x_values(&self) -> Vec<f64> {
        let mut values = Vec::new();
        for series in &self.series {
            match &series.points {
                Points::Line(points) => values.extend(points.iter().map(|p| p[0])),
                Points::Band(points) => values.extend(points.iter().map(|p| p[0])),
            }
        }
        values.extend(self.shapes.iter().flat_map(Shape::extent).map(|p| p[0]));
        values
    }

    fn y_values(&self) -> Vec<f64> {
        let mut values = Vec::new();
        for series in &self.series {
            match &series.points {
                Points::Line(points) => values.extend(points.iter().map(|p| p[1])),
                Points::Band(points) => values.extend(points.iter().flat_map(|p| [p[1], p[2]])),
            }
        }
        values.extend(self.shapes.iter().flat_map(Shape::extent).map(|p| p[1]));
        values
    }

    /// Width of the widest tick label, and the rest of what is left of the frame.
    pub(super) fn left_margin(&self) -> f64 {
        let y = self.y_ruler();
        let widest = (self.y)
            .ticks_on(&y, most_ticks(self.height, 18.0))
            .iter()
            .map(|tick| text_width(&tick.label, TICK))
            .fold(0.0, f64::max);
        widest
            + 3.5
            + if self.y.label.is_empty() {
                2.0
            } else {
                LABEL + 6.0
            }
    }

    /// The range of the data, with the bounds where that leaves the data their part.
    fn y_ruler(&self) -> Ruler {
        let values = self.y_values();
        let data = self.y.ruler(values.iter().copied(), 0.06);
        let bounds = self.bounds.iter().flat_map(|bounds| bounds.values.iter());
        // Nearest first, as many as fit.
        let span = |ruler: &Ruler| match self.y.scale {
            Scale::Linear => ruler.high - ruler.low,
            Scale::Log => (ruler.high / ruler.low).log10(),
        };
        let mut near: Vec<f64> = bounds.copied().collect();
        let with = |bound: f64| self.y.ruler(values.iter().copied().chain([bound]), 0.06);
        near.sort_by(|a, b| span(&with(*a)).total_cmp(&span(&with(*b))));
        let mut held = values.clone();
        let mut best = data;
        for bound in near {
            held.push(bound);
            let wide = self.y.ruler(held.iter().copied(), 0.06);
            if !values.is_empty() && span(&data) / span(&wide) < KEPT {
                held.pop();
            } else {
                best = wide;
            }
        }
        best
    }
}

fn most_ticks(length: f64, each: f64) -> usize {
    (length / each).floor().max(2.0) as usize
}

impl<'a> Layout<'a> {
    /// Ranges and legend of `chart` for a frame of this width.
    pub fn new(chart: &'a Chart, width: f64) -> Self {
        let margin =
            if chart.series.iter().all(|s| s.stroke != Stroke::None) && chart.shapes.is_empty() {
                0.0
            } else {
                0.05
            };
        let mut x = chart.x.ruler(chart.x_values().into_iter(), margin);
        let mut y = chart.y_ruler();
        if chart.equal_scale {
            let unit = ((x.high - x.low) / width).max((y.high - y.low) / chart.height);
            x = x.spanning(unit * width);
            y = y.spanning(unit * chart.height);
        }
        let shown: Vec<bool> = chart
            .bounds
            .iter()
            .map(|bounds| bounds.values.iter().any(|value| y.holds(*value)))
            .collect();
        let legend = Legend::new(chart, width, &shown);
        Self {
            chart,
            x,
            y,
            width,
            legend,
        }
    }

    /// Room above and below the frame.
    pub fn margins(&self) -> Margins {
        let title = if self.chart.title.is_empty() {
            0.0
        } else {
            TITLE + 5.0
        };
        let label = if self.chart.x.label.is_empty() {
            0.0
        } else {
            LABEL + 4.0
        };
        Margins {
            top: title + self.legend.height() + 4.0,
            bottom: TICK + 5.0 + label,
        }
    }

    /// Width of the frame, points.
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Height of the frame, points.
    pub fn height(&self) -> f64 {
        self.chart.height
    }

    /// What the x axis reaches from and to.
    pub fn x_range(&self) -> [f64; 2] {
        [self.x.low, self.x.high]
    }

    /// What the y axis reaches from and to.
    pub fn y_range(&self) -> [f64; 2] {
        [self.y.low, self.y.high]
    }

    /// Draws the chart, the upper left corner of its frame at (left, top).
    pub fn draw(&self, canvas: &mut Canvas, [left, top]: [f64; 2]) {
        let chart = self.chart;
        let (width, height) = (self.width, chart.height);
        let frame = Frame {
            x: self.x,
            y: self.y,
            left,
            top,
            width,
            height,
        };
        let (right, bottom) = (left + width, top + height);
        let legend_top = top - 4.0 - self.legend.height();
        self.legend.draw(canvas, [left, legend_top]);
        if !chart.title.is_empty() {
            canvas.text([left, legend_top - 4.0], Anchor::Start, TITLE, &chart.title);
        }
        canvas.clip([left, top, width, height]);
        frame.grid(canvas, chart);
        // Areas behind lines.
        for area in [true, false] {
            for (i, (series, colour)) in chart.series.iter().zip(chart.colours()).enumerate() {
                if matches!(series.points, Points::Band(_)) == area {
                    canvas.group(Part::Curve(chart.entry_of_series(i)), |canvas| {
                        frame.series(canvas, series, colour);
                    });
                }
            }
        }
        for shape in &chart.shapes {
            frame.shape(canvas, shape);
        }
        for (j, bounds) in chart.bounds.iter().enumerate() {
            canvas.group(Part::Curve(chart.entry_of_bounds(j)), |canvas| {
                for (i, value) in bounds.values.iter().enumerate() {
                    let place = frame.place([self.x.low, *value]);
                    if let Some([_, y]) = place.filter(|_| self.y.holds(*value)) {
                        let colour = bounds.colours.get(i).copied().unwrap_or(Colour::Grey);
                        canvas.path(&[[left, y], [right, y]], colour, 0.9, Stroke::Dashed);
                    }
                }
            });
        }
        canvas.unclip();
        let corners = [[left, top], [right, top], [right, bottom], [left, bottom]];
        canvas.polygon(&corners, Some((Colour::Black, 0.6)), None);
        frame.axes(canvas, chart);
    }
}

/// The frame of a chart with its ranges.
struct Frame {
    x: Ruler,
    y: Ruler,
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

impl Frame {
    /// A point of the data on the canvas.
    fn place(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        // Far beyond the frame is as good as there, and no renderer chokes on it.
        let part = |ruler: &Ruler, value| ruler.part(value).map(|part| part.clamp(-50.0, 50.0));
        Some([
            self.left + self.width * part(&self.x, x)?,
            self.top + self.height * (1.0 - part(&self.y, y)?),
        ])
    }

    fn ticks(&self, chart: &Chart) -> [Vec<Tick>; 2] {
        [
            chart.x.ticks_on(&self.x, most_ticks(self.width, 32.0)),
            chart.y.ticks_on(&self.y, most_ticks(self.height, 18.0)),
        ]
    }

    /// Faint lines at the ticks of y; boundaries of segments.
    fn grid(&self, canvas: &mut Canvas, chart: &Chart) {
        let right = self.left + self.width;
        let [_, ticks] = self.ticks(chart);
        canvas.group(Part::Ticks, |canvas| {
            for tick in ticks.iter().filter(|tick| !tick.label.is_empty()) {
                if let Some([_, y]) = self.place([self.x.low, tick.value]) {
                    let line = [[self.left, y], [right, y]];
                    canvas.path(&line, Colour::Light, 0.35, Stroke::Solid);
                }
            }
        });
        if chart.divisions.is_empty() {
            return;
        }
        canvas.group(Part::Divisions, |canvas| {
            for division in chart.divisions.iter().filter(|x| self.x.holds(**x)) {
                if let Some([x, _]) = self.place([*division, self.y.low]) {
                    let line = [[x, self.top], [x, self.top + self.height]];
                    canvas.path(&line, Colour::Light, 0.7, Stroke::Solid);
                }
            }
        });
    }

    fn axes(&self, canvas: &mut Canvas, chart: &Chart) {
        let bottom = self.top + self.height;
        let [x_ticks, y_ticks] = self.ticks(chart);
        let length = |tick: &Tick| if tick.label.is_empty() { 1.5 } else { 3.0 };
        canvas.group(Part::Ticks, |canvas| {
            for tick in &x_ticks {
                if let Some([x, _]) = self.place([tick.value, self.y.low]) {
                    let line = [[x, bottom], [x, bottom - length(tick)]];
                    canvas.path(&line, Colour::Black, 0.6, Stroke::Solid);
                    canvas.text([x, bottom + TICK + 2.0], Anchor::Middle, TICK, &tick.label);
                }
            }
            for tick in &y_ticks {
                if let Some([_, y]) = self.place([self.x.low, tick.value]) {
                    let line = [[self.left, y], [self.left + length(tick), y]];
                    canvas.path(&line, Colour::Black, 0.6, Stroke::Solid);
                    let at = [self.left - 3.0, y + 0.36 * TICK];
                    canvas.text(at, Anchor::End, TICK, &tick.label);
                }
            }
        });
        let centre = [self.left + 0.5 * self.width, self.top + 0.5 * self.height];
        if !chart.x.label.is_empty() {
            let at = [centre[0], bottom + TICK + LABEL + 5.0];
            canvas.text(at, Anchor::Middle, LABEL, &chart.x.label);
        }
        if !chart.y.label.is_empty() {
            let at = [self.left - chart.left_margin() + LABEL, centre[1]];
            canvas.upward_text(at, LABEL, &chart.y.label);
        }
    }

    fn series(&self, canvas: &mut Canvas, series: &Series, colour: Colour) {
        match &series.points {
            Points::Band(points) => {
                let edge = |i: usize| points.iter().filter_map(move |p| self.place([p[0], p[i]]));
                let upper: Vec<_> = edge(2).collect();
                let outline: Vec<_> = edge(1).chain(upper.into_iter().rev()).collect();
                if outline.len() > 2 {
                    canvas.polygon(&outline, None, Some((colour, BAND)));
                }
            }
            Points::Line(points) => {
                let places: Vec<_> = points.iter().map(|point| self.place(*point)).collect();
                for run in places.split(Option::is_none) {
                    let run: Vec<[f64; 2]> = run.iter().copied().flatten().collect();
                    canvas.path(&run, colour, series.width, series.stroke);
                }
                if let Some(marker) = series.marker {
                    for place in places.into_iter().flatten() {
                        mark(canvas, place, marker, colour);
                    }
                }
            }
        }
    }

    fn shape(&self, canvas: &mut Canvas, shape: &Shape) {
        let places = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
            points
                .iter()
                .filter_map(|point| self.place(*point))
                .collect()
        };
        match shape {
            Shape::Polygon {
                corners,
                outline,
                fill,
            } => canvas.polygon(&places(corners), Some((*outline, 0.7)), *fill),
            Shape::Path {
                points,
                colour,
                width,
                stroke,
            } => canvas.path(&places(points), *colour, *width, *stroke),
            Shape::Disc {
                centre,
                radius,
                fill,
            } => {
                if let Some(place) = self.place(*centre) {
                    canvas.circle(place, *radius, Colour::Black, Some(*fill));
                }
            }
            Shape::Label { at, text } => {
                if let Some([x, y]) = self.place(*at) {
                    canvas.text([x, y + 0.36 * TICK], Anchor::Middle, TICK, text);
                }
            }
        }
    }
}
