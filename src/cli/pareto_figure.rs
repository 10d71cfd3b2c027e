//! The trade-off curve as a figure.

use super::pareto_report::Row;
use crate::plot::{Axis, Chart, Figure, Marker, Series, Width};

/// Base motion over joint effort, and the base's angles over the factor.
pub(super) fn figure(name: &str, rows: &[Row]) -> Figure {
    let solved: Vec<&Row> = rows.iter().filter(|row| row.is_solved()).collect();
    let of = |value: fn(&Row) -> f64| solved.iter().map(|row| value(row)).collect::<Vec<f64>>();
    let (base, joints) = (of(|row| row.base_motion), of(|row| row.joint_effort));
    let curve = Chart::new(Axis::log("Joint effort E"), Axis::log("Base motion B"))
        .title("(a) Terms of the cost")
        .series(Series::line("", &joints, &base).marker(Marker::Disc))
        .height(150.0);
    let factor = of(|row| row.factor);
    let angles = Chart::new(
        Axis::log("Factor on the base's weights"),
        Axis::linear("Angle (deg)"),
    )
    .title("(b) Base attitude")
    .series(
        Series::line(
            "largest",
            &factor,
            &of(|row| row.max_base_attitude.to_degrees()),
        )
        .marker(Marker::Disc),
    )
    .series(
        Series::line(
            "final",
            &factor,
            &of(|row| row.final_base_attitude.to_degrees()),
        )
        .marker(Marker::Square),
    )
    .height(150.0);
    let description = format!("{name}: base motion against joint effort");
    Figure::new(&description, Width::Page)
        .columns(2)
        .panel(curve)
        .panel(angles)
}
