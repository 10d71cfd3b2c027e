//! Figures 4 and 5: the arm and its base at several times, to scale.

use super::{Case, Sample, Sampler};
use crate::plot::{Axis, Chart, Colour, Figure, Shape, Stroke, Width};

/// Pictures of a sequence, evenly over the duration.
const PICTURES: usize = 6;

/// The sequence of `case`; `None` where the motion is not planar.
///
/// The base is drawn as a square that reaches to the first joint.
pub fn sequence(case: &Case, method: &str) -> Option<Figure> {
    let mut sampler = Sampler::new(case)?;
    let samples: Vec<Sample> = (0..PICTURES)
        .map(|k| sampler.at(k as f64 / (PICTURES - 1) as f64))
        .collect();
    let first = &samples[0];
    let [base, joint] = [first.skeleton[0], *first.skeleton.get(1)?];
    let half = (joint[0] - base[0]).hypot(joint[1] - base[1]);
    let outline = |sample: &Sample| -> Vec<[f64; 2]> {
        let (s, c) = sample.attitude.to_radians().sin_cos();
        [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]
            .iter()
            .map(|[x, y]| {
                let [x, y] = [x * half, y * half];
                [
                    sample.position[0] + c * x - s * y,
                    sample.position[1] + s * x + c * y,
                ]
            })
            .collect()
    };
    // The same window for every picture.
    let mut low = [f64::INFINITY; 2];
    let mut high = [f64::NEG_INFINITY; 2];
    for point in samples
        .iter()
        .flat_map(|s| outline(s).into_iter().chain(s.skeleton.clone()))
    {
        low = [0, 1].map(|i| low[i].min(point[i]));
        high = [0, 1].map(|i| high[i].max(point[i]));
    }
    let axis = |label: &str, i: usize| Axis::linear(label).range(low[i] - 0.05, high[i] + 0.05);
    let description = format!("Motion sequence under {method}, to scale");
    let mut figure = Figure::new(&description, Width::Page).columns(3);
    for sample in &samples {
        let mut start = outline(first);
        start.push(start[0]);
        let arm = sample.skeleton[1..].to_vec();
        let mut chart = Chart::new(axis("x (m)", 0), axis("y (m)", 1))
            .title(
                &format!(
                    "{method}, t = {:.0} s, base {:.1}°",
                    sample.t, sample.attitude
                )
                .replace('-', "−")
                .replace("A−RPM", "A-RPM"),
            )
            .equal_scale()
            .height(105.0)
            .shape(Shape::Path {
                points: start,
                colour: Colour::Grey,
                width: 0.7,
                stroke: Stroke::Dashed,
            })
            .shape(Shape::Polygon {
                corners: outline(sample),
                outline: Colour::Black,
                fill: Some((Colour::Sky, 0.5)),
            })
            .shape(Shape::Path {
                points: arm.clone(),
                colour: Colour::Blue,
                width: 2.2,
                stroke: Stroke::Solid,
            });
        let joints = case.problem.robot.joint_count();
        for centre in arm.into_iter().take(joints) {
            chart = chart.shape(Shape::Disc {
                centre,
                radius: 2.2,
                fill: Colour::Orange,
            });
        }
        figure = figure.panel(chart);
    }
    Some(figure)
}
