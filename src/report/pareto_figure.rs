//! The trade-off curve as a figure.

use super::ParetoReport;
use super::pareto::ParetoRow;
use crate::plot::{Axis, Chart, Figure, Marker, Series, Width};

impl ParetoReport<'_> {
    /// Base motion over joint effort, and the base's angles over the factor; solved points only.
    pub fn figure(&self) -> Figure {
        let description = format!("{}: base motion against joint effort", self.name);
        let curve = self.curve().title("(a) Terms of the cost");
        let angles = self.angles().title("(b) Base attitude");
        Figure::new(&description, Width::Page)
            .columns(2)
            .panel(curve.height(150.0))
            .panel(angles.height(150.0))
    }

    /// Base motion over joint effort.
    pub(super) fn curve(&self) -> Chart {
        let (base, joints) = (
            self.solved(|row| row.base_motion),
            self.solved(|row| row.joint_effort),
        );
        Chart::new(
            axis("Joint effort E", &joints),
            axis("Base motion B", &base),
        )
        .series(
            Series::line("", &joints, &base)
                .named("base motion B")
                .marker(Marker::Disc),
        )
    }

    /// The base's angles over the factor.
    pub(super) fn angles(&self) -> Chart {
        let factor = self.solved(|row| row.factor);
        let largest = self.solved(|row| row.max_base_attitude.to_degrees());
        let last = self.solved(|row| row.final_base_attitude.to_degrees());
        Chart::new(
            Axis::log("Factor on the base's weights"),
            Axis::linear("Angle (deg)"),
        )
        // The larger marker is seen where both are the same.
        .series(
            Series::line("largest", &factor, &largest)
                .width(2.2)
                .marker(Marker::Square),
        )
        .series(Series::line("final", &factor, &last).marker(Marker::Cross))
    }

    fn solved(&self, value: fn(&ParetoRow) -> f64) -> Vec<f64> {
        let solved = self.rows.iter().filter(|row| row.is_solved());
        solved.map(value).collect()
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
