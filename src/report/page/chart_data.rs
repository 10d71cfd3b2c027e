//! The numbers behind the charts, for what the page says at the cursor and for downloads.

use super::charts::Panel;
use crate::plot::Colour;
use crate::text::digits;
use serde::Serialize;

/// Significant digits, more than a screen shows.
const DIGITS: i32 = 6;

/// All charts of a page.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct ChartData {
    /// Columns of x, which curves name by their number.
    x: Vec<Vec<f64>>,
    charts: Vec<Numbers>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct Numbers {
    heading: String,
    x_label: String,
    y_label: String,
    curves: Vec<Numbered>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct Numbered {
    name: String,
    /// The number of its entry in the legend.
    entry: usize,
    colour: String,
    /// The number of its column of x.
    x: usize,
    /// Null where it is not a number.
    y: Vec<f64>,
}

impl ChartData {
    /// The numbers of `panels`, in their order.
    pub fn of(panels: &[Panel]) -> Self {
        let mut found = Self {
            x: Vec::new(),
            charts: Vec::new(),
        };
        for panel in panels {
            for shown in panel.figure.contents() {
                let curves = shown.curves.iter().map(|curve| Numbered {
                    name: curve.name.into(),
                    entry: curve.entry,
                    colour: Colour::hex(curve.colour),
                    x: found.column(curve.points.iter().map(|[x, _]| rounded(*x)).collect()),
                    y: curve.points.iter().map(|[_, y]| rounded(*y)).collect(),
                });
                let curves = curves.collect();
                found.charts.push(Numbers {
                    heading: panel.heading.clone(),
                    x_label: shown.x_label.into(),
                    y_label: shown.y_label.into(),
                    curves,
                });
            }
        }
        found
    }

    /// The number of this column, which is added where it is new.
    fn column(&mut self, values: Vec<f64>) -> usize {
        let known = self.x.iter().position(|column| *column == values);
        known.unwrap_or_else(|| {
            self.x.push(values);
            self.x.len() - 1
        })
    }

    /// As JSON that may stand in a script element.
    ///
    /// # Errors
    /// None that is expected.
    pub fn json(&self) -> serde_json::Result<String> {
        Ok(serde_json::to_string(self)?.replace('<', "\\u003c"))
    }
}

fn rounded(value: f64) -> f64 {
    digits::rounded(value, DIGITS)
}
