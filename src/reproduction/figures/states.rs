//! Figure 2: trajectories of base and joints.

use super::{Case, Sample, Sampler};
use crate::ocp::Interval;
use crate::plot::{Axis, Chart, Colour, Figure, Series, Width};

/// The three panels of figure 2 for one case; `None` where the motion is not planar.
pub fn states(case: &Case) -> Option<Figure> {
    let samples = Sampler::new(case)?.samples();
    let problem = &case.problem;
    let mesh = &case.trajectory;
    let inner = mesh.mesh.breakpoints();
    let cuts: Vec<f64> = inner[1..inner.len() - 1]
        .iter()
        .map(|fraction| fraction * mesh.duration)
        .collect();
    let start = samples[0].position;
    let t: Vec<f64> = samples.iter().map(|sample| sample.t).collect();
    let line = |label: &str, value: &dyn Fn(&Sample) -> f64| {
        let y: Vec<f64> = samples.iter().map(value).collect();
        Series::line(label, &t, &y)
    };
    let time = || Axis::linear("Time (s)");
    let n = problem.robot.joint_count();
    let mut angles = Chart::new(time(), Axis::linear("Angle (deg)"))
        .title(&format!(
            "(a) Base attitude and joint angles, {} case",
            case.name
        ))
        .series(line("base", &|sample| sample.attitude).colour(Colour::Black))
        .divisions(&cuts);
    let mut rates = Chart::new(time(), Axis::linear("Rate (deg/s)"))
        .title("(b) Angular velocities")
        .series(line("base", &|sample| sample.rate).colour(Colour::Black))
        .divisions(&cuts);
    for j in 0..n {
        let label = format!("joint {}", j + 1);
        angles = angles.series(line(&label, &|sample| sample.joints[j]));
        rates = rates.series(line(&label, &|sample| sample.joint_rates[j]));
    }
    let limits = &problem.limits;
    angles = bounded(angles, "joint limit", &limits.joint_position, "°");
    angles = bounded(angles, "bound on the base", &limits.base_attitude, "°");
    rates = bounded(rates, "joint limit", &limits.joint_velocity, "°/s");
    rates = bounded(rates, "base limit", &limits.base_rate, "°/s");
    let displacement = Chart::new(time(), Axis::linear("Displacement (cm)"))
        .title("(c) Base displacement")
        .series(line("x", &|sample| 100.0 * (sample.position[0] - start[0])))
        .series(line("y", &|sample| 100.0 * (sample.position[1] - start[1])))
        .divisions(&cuts);
    let description = format!("Planned motion of base and joints, {} case", case.name);
    Some(
        Figure::new(&description, Width::Column)
            .panel(angles)
            .panel(rates)
            .panel(displacement.height(80.0)),
    )
}

/// The chart with the first component's bounds, in degrees, where it has any.
fn bounded(chart: Chart, label: &str, bounds: &[Interval], unit: &str) -> Chart {
    let Some(first) = bounds.first().filter(|bounds| !bounds.is_free()) else {
        return chart;
    };
    let values: Vec<f64> = [first.lower, first.upper]
        .into_iter()
        .filter(|bound| bound.is_finite())
        .map(f64::to_degrees)
        .collect();
    let label = if first.lower == -first.upper {
        format!("{label} ±{:.1}{unit}", first.upper.to_degrees())
    } else {
        label.into()
    };
    chart.bounds(&label, &values)
}
