//! Figure 6: base and joints under the methods compared.

use super::{Case, Sample, Sampler};
use crate::plot::{Axis, Chart, Colour, Figure, Marker, Series, Stroke, Width};

/// Measurements of Section IV.B.
struct Measurement {
    name: &'static str,
    /// Largest and final base attitude, deg.
    attitude: [f64; 2],
    /// Final displacement in x and y, cm.
    displacement: [f64; 2],
    colour: Colour,
    marker: Marker,
}

const MEASURED: [Measurement; 2] = [
    Measurement {
        name: "A-RPM, published",
        attitude: [16.4, 9.0],
        displacement: [3.2, 4.2],
        colour: Colour::Blue,
        marker: Marker::Diamond,
    },
    Measurement {
        name: "MATPM, published",
        attitude: [25.8, 25.8],
        displacement: [6.5, 13.4],
        colour: Colour::Vermilion,
        marker: Marker::Square,
    },
];

/// The panels of figure 6 for several plans by name; `None` where a motion is not planar.
///
/// The paper gives its measurements without sign; they are drawn by their magnitude, ours as well.
pub fn comparison(cases: &[(&str, &Case)]) -> Option<Figure> {
    let duration = cases.first()?.1.trajectory.duration;
    let time = || Axis::linear("Time (s)").range(0.0, 1.02 * duration);
    let mut attitude =
        Chart::new(time(), Axis::linear("|Attitude| (deg)")).title("(a) Attitude of the base");
    let mut displacement = Chart::new(time(), Axis::linear("Displacement (cm)"))
        .title("(b) Displacement of the base: x solid, y dotted");
    let mut joints = Chart::new(time(), Axis::linear("Angle (deg)"))
        .title("(c) Joint angles: first solid, second dotted");
    let colours = [Colour::Blue, Colour::Green, Colour::Vermilion];
    for (k, (name, case)) in cases.iter().enumerate() {
        let colour = if k + 1 == cases.len() {
            colours[2]
        } else {
            colours[k % 2]
        };
        let samples = Sampler::new(case)?.samples();
        let t: Vec<f64> = samples.iter().map(|sample| sample.t).collect();
        let line = |label: &str, value: &dyn Fn(&Sample) -> f64| {
            let y: Vec<f64> = samples.iter().map(value).collect();
            Series::line(label, &t, &y).colour(colour)
        };
        let start = samples[0].position;
        let moved = |i: usize| move |sample: &Sample| 100.0 * (sample.position[i] - start[i]);
        attitude = attitude.series(line(name, &|sample| sample.attitude.abs()));
        displacement = displacement
            .series(line(name, &moved(0)))
            .series(line("", &moved(1)).stroke(Stroke::Dotted));
        joints = joints.series(line(name, &|sample| sample.joints[0]));
        if samples[0].joints.len() > 1 {
            joints = joints.series(line("", &|sample| sample.joints[1]).stroke(Stroke::Dotted));
        }
    }
    // The first of two marks stands a little earlier, so that it is seen which is which.
    let at = [0.97 * duration, duration];
    for measured in MEASURED {
        let marks = |what: &str, values: &[f64; 2]| {
            let label = format!("{}: {what}", measured.name);
            Series::scatter(&label, &at, values, measured.marker).colour(measured.colour)
        };
        attitude = attitude.series(marks("largest, final", &measured.attitude));
        displacement = displacement.series(marks("x, y", &measured.displacement));
    }
    let limit = cases.first()?.1.problem.limits.joint_position.first()?;
    let limits = [limit.lower, limit.upper].map(f64::to_degrees);
    joints = joints.bounds("joint limit", &limits);
    attitude = attitude.bounds("published bound ±15°", &[15.0]);
    Some(
        Figure::new("Base and joints under A-RPM and MATPM", Width::Column)
            .panel(attitude)
            .panel(displacement)
            .panel(joints),
    )
}
