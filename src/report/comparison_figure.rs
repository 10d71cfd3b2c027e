//! The comparison as one figure: base and joints over time, a line a planner.

use crate::collocation::Mesh;
use crate::dynamics::JointKind;
use crate::ocp::Interval;
use crate::planner::Plan;
use crate::plot::{Axis, Chart, Colour, Figure, Series, Stroke, Width};
use crate::problem::Problem;
use crate::study::Comparison;
use crate::system::{Trajectory, limited_angles, resampled};
use crate::text::digits::digits;

/// Segments of two points that a motion is drawn with.
const SEGMENTS: usize = 150;

/// A panel for every base angle, one for the displacement and one for every joint; lines are solid
/// where a planner optimises, limits stand in the titles.
pub fn comparison_figure(problem: &Problem, found: &Comparison) -> Figure {
    let drawn = found
        .entries
        .iter()
        .filter_map(|entry| Some((entry.method, entry.plan.as_ref().ok()?)));
    let curves: Vec<Curve> = drawn
        .enumerate()
        .filter_map(|(number, (method, plan))| {
            Some(Curve {
                label: method.name(),
                number,
                optimised: method.optimises(),
                motion: smooth(problem, plan)?,
            })
        })
        .collect();
    let names: &[&str] = match (problem.attitude_sizes().1, problem.robot.plane()) {
        (3, _) => &["Base roll", "Base pitch", "Base yaw"],
        (_, Some(_)) => &["Base attitude"],
        (_, None) => &["Base turned by"],
    };
    let degrees = 1f64.to_degrees();
    let limits = &problem.limits;
    let mut panels = Vec::new();
    for (i, &name) in names.iter().enumerate() {
        let limit = limits.base_attitude.get(i);
        let chart = panel("Angle (deg)", &curves, |motion| {
            column(&limited_angles(motion), i, degrees)
        });
        panels.push((name, chart, Limit::new(limit, degrees, "°")));
    }
    let moved = panel("Distance (cm)", &curves, displacement);
    panels.push(("Base displacement", moved, None));
    for (j, joint) in problem.robot.joints().iter().enumerate() {
        let (factor, axis, unit) = match joint.kind {
            JointKind::Revolute => (degrees, "Angle (deg)", "°"),
            JointKind::Prismatic => (100.0, "Position (cm)", " cm"),
        };
        let limit = limits.joint_position.get(j);
        let chart = panel(axis, &curves, |motion| {
            column(&motion.joint_position, j, factor)
        });
        panels.push((&joint.name, chart, Limit::new(limit, factor, unit)));
    }
    let limited = panels.iter().any(|(_, _, limit)| limit.is_some());
    let description = format!("{} by every planner", problem.name);
    let mut figure = Figure::new(&description, Width::Page).columns(2);
    for (number, (name, mut chart, limit)) in panels.into_iter().enumerate() {
        let letter = char::from(b'a' + (number % 26) as u8);
        let mut title = format!("({letter}) {name}");
        if let Some(limit) = limit {
            title.push_str(&limit.title);
            chart = chart.bounds("", &limit.values);
        }
        // One legend for all panels; a dashed line stands for the limit in any of them.
        chart = match number {
            0 if limited => chart.entry("limit", Colour::Grey, Stroke::Dashed),
            0 => chart,
            _ => chart.without_legend(),
        };
        figure = figure.panel(chart.title(&title));
    }
    figure
}

/// A limit that is drawn where it is near enough, and named in any case.
struct Limit {
    title: String,
    values: Vec<f64>,
}

impl Limit {
    fn new(bound: Option<&Interval>, factor: f64, unit: &str) -> Option<Self> {
        let bound = bound.filter(|bound| !bound.is_free())?;
        let [lower, upper] = [bound.lower, bound.upper].map(|value| factor * value);
        let title = if lower == -upper {
            format!(", limit ±{}{unit}", digits(upper, 1, 2))
        } else {
            let text = |value: f64| format!("{}{unit}", digits(value, 1, 2)).replace('-', "−");
            match (lower.is_finite(), upper.is_finite()) {
                (true, true) => format!(", limits {} and {}", text(lower), text(upper)),
                (true, false) => format!(", at least {}", text(lower)),
                (false, _) => format!(", at most {}", text(upper)),
            }
        };
        let values = [lower, upper].into_iter().filter(|value| value.is_finite());
        Some(Self {
            title,
            values: values.collect(),
        })
    }
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

fn panel(axis: &str, curves: &[Curve], values: impl Fn(&Trajectory) -> Vec<f64>) -> Chart {
    let mut chart = Chart::new(Axis::linear("Time (s)"), Axis::linear(axis));
    for curve in curves {
        let stroke = match curve.optimised {
            true => Stroke::Solid,
            false => Stroke::Dotted,
        };
        let line = Series::line(curve.label, &curve.motion.t, &values(&curve.motion))
            .colour(Colour::of_series(curve.number))
            .stroke(stroke);
        chart = chart.series(if curve.number == 0 {
            line.width(2.4)
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
