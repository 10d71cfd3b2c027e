//! What a panel shows, as numbers.

use super::series::Points;
use super::{Chart, Colour};

/// One panel of a figure.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Contents<'a> {
    /// The label of the x axis.
    pub x_label: &'a str,
    /// That of the y axis.
    pub y_label: &'a str,
    /// Lines and markers; bands are left out.
    pub curves: Vec<Curve<'a>>,
}

/// One curve.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Curve<'a> {
    /// What it is called.
    pub name: &'a str,
    /// The number of its entry in the legend.
    pub entry: usize,
    /// What it is drawn in.
    pub colour: Colour,
    /// (x, y)
    pub points: &'a [[f64; 2]],
}

impl<'a> Contents<'a> {
    pub(super) fn of(chart: &'a Chart) -> Self {
        let numbered = chart.series.iter().zip(chart.colours()).enumerate();
        let curve = |(i, (series, colour)): (usize, (&'a super::Series, Colour))| {
            let Points::Line(points) = &series.points else {
                return None;
            };
            Some(Curve {
                name: series.name.as_ref().unwrap_or(&series.label),
                entry: chart.entry_of_series(i),
                colour,
                points,
            })
        };
        Self {
            x_label: &chart.x.label,
            y_label: &chart.y.label,
            curves: numbered.filter_map(curve).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::{Axis, Figure, Series, Width};

    #[test]
    fn curves_without_a_label_belong_to_the_last_that_has_one() {
        let [x, y] = [[0.0, 1.0], [2.0, 3.0]];
        let chart = Chart::new(Axis::linear("t"), Axis::linear("v"))
            .series(Series::line("a", &x, &y))
            .series(Series::line("b", &x, &y).colour(Colour::Grey))
            .series(Series::line("", &x, &y).named("b, again"))
            .coloured_bounds("limits", &[(2.0, Colour::Green)]);
        let figure = Figure::new("", Width::Column).panel(chart);
        let contents = figure.contents();
        let curves: Vec<_> = contents[0]
            .curves
            .iter()
            .map(|curve| (curve.name, curve.entry, curve.colour))
            .collect();
        let blue = Colour::of_series(0);
        assert_eq!(
            curves,
            [
                ("a", 0, blue),
                ("b", 1, Colour::Grey),
                ("b, again", 1, Colour::of_series(1))
            ]
        );
        let svg = figure.svg_with_groups();
        for (part, count) in [("curve=\"1\"", 2), ("curve=\"3\"", 1), ("entry=\"3\"", 1)] {
            assert_eq!(svg.matches(part).count(), count, "{part}");
        }
        assert!(!figure.svg().contains("data-"));
    }
}
