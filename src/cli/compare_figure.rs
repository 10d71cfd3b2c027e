//! The comparison as one figure: base and joints over time, a line a planner: solid where it optimises.

use super::compare::Entry;
use crate::collocation::Mesh;
use crate::dynamics::JointKind;
use crate::ocp::Interval;
use crate::planner::{Plan, Problem, Trajectory, resampled, turned};
use crate::plot::{Axis, Chart, Colour, Figure, Series, Stroke, Width};

/// Segments of two points that a motion is drawn with.
const SEGMENTS: usize = 150;

/// A panel for every base angle, one for the displacement and one for every joint.
pub(super) fn figure(problem: &Problem, entries: &[&Entry]) -> Figure {
    let curves: Vec<Curve> = entries
        .iter()
        .enumerate()
        .filter_map(|(number, entry)| {
            let plan = entry.plan.as_ref().ok()?;
            Some(Curve {
                label: entry.method.name(),
                number,
                optimised: entry.method.optimises(),
                motion: smooth(problem, plan)?,
            })
        })
        .collect();
    let description = format!("{} by every planner", problem.name);
    let mut figure = Figure::new(&description, Width::Page).columns(2);
    let mut letter = 'a'..='z';
    let mut title = |text: &str| match letter.next() {
        Some(letter) => format!("({letter}) {text}"),
        None => text.to_string(),
    };
    let names: &[&str] = match (problem.attitude_sizes().1, problem.robot.plane()) {
        (3, _) => &["Base roll", "Base pitch", "Base yaw"],
        (_, Some(_)) => &["Base attitude"],
        (_, None) => &["Base turned by"],
    };
    let degrees = 1f64.to_degrees();
    for (i, name) in names.iter().enumerate() {
        let chart = panel(&title(name), "Angle (deg)", &curves, |motion| {
            column(&turned(motion), i, degrees)
        });
        let chart = bounded(chart, problem.limits.base_attitude.get(i), degrees);
        let chart = if i == 0 {
            chart
        } else {
            chart.without_legend()
        };
        figure = figure.panel(chart);
    }
    let chart = panel(
        &title("Base displacement"),
        "Distance (cm)",
        &curves,
        displacement,
    );
    figure = figure.panel(chart.without_legend());
    for (j, joint) in problem.robot.joints().iter().enumerate() {
        let (factor, axis) = match joint.kind {
            JointKind::Revolute => (degrees, "Angle (deg)"),
            JointKind::Prismatic => (100.0, "Position (cm)"),
        };
        let chart = panel(&title(&joint.name), axis, &curves, |motion| {
            column(&motion.joint_position, j, factor)
        });
        let chart = bounded(chart, problem.limits.joint_position.get(j), factor);
        figure = figure.panel(chart.without_legend());
    }
    figure
}

struct Curve {
    label: &'static str,
    number: usize,
    optimised: bool,
    motion: Trajectory,
}

fn smooth(problem: &Problem, plan: &Plan) -> Option<Trajectory> {
    let mesh = Mesh::uniform(SEGMENTS, 2).ok()?;
    Some(resampled(problem, &plan.discretization, mesh))
}

fn panel(
    title: &str,
    axis: &str,
    curves: &[Curve],
    values: impl Fn(&Trajectory) -> Vec<f64>,
) -> Chart {
    let mut chart = Chart::new(Axis::linear("Time (s)"), Axis::linear(axis)).title(title);
    for curve in curves {
        let stroke = match curve.optimised {
            true => Stroke::Solid,
            false => Stroke::Dotted,
        };
        let line = Series::line(curve.label, &curve.motion.t, &values(&curve.motion))
            .colour(Colour::of_series(curve.number))
            .stroke(stroke);
        chart = chart.series(if curve.number == 0 {
            line.width(1.6)
        } else {
            line
        });
    }
    chart
}

fn column(rows: &[Vec<f64>], i: usize, factor: f64) -> Vec<f64> {
    rows.iter().map(|row| factor * row[i]).collect()
}

fn displacement(motion: &Trajectory) -> Vec<f64> {
    let from = &motion.base_position[0];
    let distance = |row: &Vec<f64>| {
        let squares = row.iter().zip(from).map(|(a, b)| (a - b).powi(2));
        100.0 * squares.sum::<f64>().sqrt()
    };
    motion.base_position.iter().map(distance).collect()
}

fn bounded(chart: Chart, bound: Option<&Interval>, factor: f64) -> Chart {
    let values: Vec<f64> = bound
        .into_iter()
        .flat_map(|b| [b.lower, b.upper])
        .filter(|b| b.is_finite())
        .map(|b| factor * b)
        .collect();
    match values.is_empty() {
        true => chart,
        false => chart.bounds("limit", &values),
    }
}
