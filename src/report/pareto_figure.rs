//! The trade-off curve as a figure.

use super::ParetoReport;
use super::pareto::ParetoRow;
use crate::plot::{Axis, Chart, Figure, Marker, Series, Width};

impl ParetoReport<'_> {
    /// Base motion over joint effort, and the base's angles over the factor; solved points only.
    pub fn figure(&self) -> Figure {
        let solved: Vec<&ParetoRow> = self.rows.iter().filter(|row| row.is_solved()).collect();
        let of =
            |value: fn(&ParetoRow) -> f64| solved.iter().map(|row| value(row)).collect::<Vec<_>>();
        let (base, joints) = (of(|row| row.base_motion), of(|row| row.joint_effort));
        let curve = Chart::new(
            axis("Joint effort E", &joints),
            axis("Base motion B", &base),
        )
        .title("(a) Terms of the cost")
        .series(Series::line("", &joints, &base).marker(Marker::Disc));
        let factor = of(|row| row.factor);
        let largest = of(|row| row.max_base_attitude.to_degrees());
        let last = of(|row| row.final_base_attitude.to_degrees());
        let angles = Chart::new(
            Axis::log("Factor on the base's weights"),
            Axis::linear("Angle (deg)"),
        )
        .title("(b) Base attitude")
        // The larger marker is seen where both are the same.
        .series(
            Series::line("largest", &factor, &largest)
                .width(2.2)
                .marker(Marker::Square),
        )
        .series(Series::line("final", &factor, &last).marker(Marker::Cross));
        let description = format!("{}: base motion against joint effort", self.name);
        Figure::new(&description, Width::Page)
            .columns(2)
            .panel(curve.height(150.0))
            .panel(angles.height(150.0))
    }
}

/// Logarithmic where the values span more than a decade; else it would have few ticks or none.
fn axis(label: &str, values: &[f64]) -> Axis {
    let [low, high] = values.iter().fold([f64::INFINITY, 0.0], |[low, high], &v| {
        [v.min(low), v.max(high)]
    });
    if high > 10.0 * low {
        Axis::log(label)
    } else {
        Axis::linear(label)
    }
}
