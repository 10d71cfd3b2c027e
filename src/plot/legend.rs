//! The legend: samples and labels in rows above the chart.

use super::canvas::{Anchor, Canvas, Part};
use super::marks::{BAND, mark};
use super::series::Points;
use super::text::text_width;
use super::{Chart, Colour, Marker, Stroke};

/// Size of the text, points.
const SIZE: f64 = 7.0;
/// Height of a row, points.
const ROW: f64 = 9.5;
/// Length of a sample, points.
const SAMPLE: f64 = 15.0;
const GAP: f64 = 3.0;
const BETWEEN: f64 = 9.0;

#[derive(Debug, Clone)]
struct Entry {
    number: usize,
    label: String,
    colour: Colour,
    stroke: Stroke,
    width: f64,
    marker: Option<Marker>,
    area: bool,
}

/// Entries in rows.
#[derive(Debug, Clone)]
pub(super) struct Legend {
    /// Entries with their distance from the left end.
    rows: Vec<Vec<(f64, Entry)>>,
}

impl Legend {
    /// The legend of `chart` with rows of at most `width`; `shown` tells whether bounds are drawn.
    pub fn new(chart: &Chart, width: f64, shown: &[bool]) -> Self {
        let mut entries = Vec::new();
        for (i, (series, colour)) in chart.series.iter().zip(chart.colours()).enumerate() {
            entries.push(Entry {
                number: chart.entry_of_series(i),
                label: series.label.clone(),
                colour,
                stroke: series.stroke,
                width: series.width,
                marker: series.marker,
                area: matches!(series.points, Points::Band(_)),
            });
        }
        for (j, (bounds, shown)) in chart.bounds.iter().zip(shown).enumerate() {
            let beyond = if *shown { "" } else { " (beyond the axis)" };
            entries.push(Entry {
                number: chart.entry_of_bounds(j),
                label: if bounds.label.is_empty() {
                    String::new()
                } else {
                    format!("{}{beyond}", bounds.label)
                },
                colour: bounds.common_colour(),
                stroke: Stroke::Dashed,
                width: 0.9,
                marker: None,
                area: false,
            });
        }
        let others = chart.entries.iter().enumerate();
        entries.extend(others.map(|(k, (label, colour, stroke))| Entry {
            number: chart.entry_of_bounds(chart.bounds.len() + k),
            label: label.clone(),
            colour: *colour,
            stroke: *stroke,
            width: 0.9,
            marker: None,
            area: false,
        }));
        let mut rows: Vec<Vec<(f64, Entry)>> = Vec::new();
        let mut end = f64::INFINITY;
        for entry in entries {
            if !chart.legend || entry.label.is_empty() {
                continue;
            }
            let wide = SAMPLE + GAP + text_width(&entry.label, SIZE);
            if end + wide > width || rows.is_empty() {
                rows.push(Vec::new());
                end = 0.0;
            }
            let row = rows.len() - 1;
            rows[row].push((end, entry));
            end += wide + BETWEEN;
        }
        Self { rows }
    }

    /// Height of all rows, points.
    pub fn height(&self) -> f64 {
        ROW * self.rows.len() as f64
    }

    /// Draws the rows with their upper left corner at (x, y).
    pub fn draw(&self, canvas: &mut Canvas, [x, y]: [f64; 2]) {
        for (k, row) in self.rows.iter().enumerate() {
            let middle = y + ROW * (k as f64 + 0.5);
            for (offset, entry) in row {
                canvas.group(Part::Entry(entry.number), |canvas| {
                    let from = x + offset;
                    let line = [[from, middle], [from + SAMPLE, middle]];
                    if entry.area {
                        let corners = [
                            [from, middle - 3.0],
                            [from + SAMPLE, middle - 3.0],
                            [from + SAMPLE, middle + 3.0],
                            [from, middle + 3.0],
                        ];
                        canvas.polygon(&corners, None, Some((entry.colour, BAND)));
                    } else {
                        canvas.path(&line, entry.colour, entry.width, entry.stroke);
                    }
                    if let Some(marker) = entry.marker {
                        mark(canvas, [from + 0.5 * SAMPLE, middle], marker, entry.colour);
                    }
                    let at = [from + SAMPLE + GAP, middle + 0.35 * SIZE];
                    canvas.text(at, Anchor::Start, SIZE, &entry.label);
                });
            }
        }
    }
}
