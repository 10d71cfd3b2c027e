//! The planned motion over time with its bounds, one chart a quantity.

use crate::dynamics::JointKind;
use crate::dynamics::attitude::Attitude;
use crate::ocp::Interval;
use crate::plot::{Axis, Chart, Colour, Figure, Marker, Series, Stroke, Width};
use crate::problem::Problem;
use crate::solution::{Iteration, Solution};
use crate::system::{Trajectory, base_angles, finely, limited_angles};
use crate::text::digits::rounded;
use crate::transcription::Discretization;

/// Part of the duration at its end over which bounds of the end alone are drawn.
const END: f64 = 0.05;

/// A figure of one chart with its heading.
pub(super) struct Panel {
    pub heading: String,
    pub figure: Figure,
    /// Whether its x axis is time, for the cursor of the playback.
    pub over_time: bool,
}

/// The charts of `plan`; `straight` is the motion it is compared with, where there is one.
pub(super) fn panels(
    solution: &Solution,
    problem: &Problem,
    plan: &Discretization,
    straight: Option<&Trajectory>,
) -> Vec<Panel> {
    let Some(rows) = finely(problem, plan) else {
        return Vec::new();
    };
    let inner = plan.mesh.breakpoints();
    let inner = inner.iter().map(|fraction| fraction * plan.duration);
    let drawing = Drawing {
        problem,
        rows: &rows,
        straight,
        divisions: inner.skip(1).take(plan.mesh.segments() - 1).collect(),
    };
    let mut panels = vec![drawing.attitude(), drawing.displacement(), drawing.rate()];
    for kind in [JointKind::Revolute, JointKind::Prismatic] {
        panels.extend(drawing.joints(kind));
    }
    panels.push(points(plan));
    panels.extend(errors(solution));
    panels
}

struct Drawing<'a> {
    problem: &'a Problem,
    rows: &'a Trajectory,
    straight: Option<&'a Trajectory>,
    /// Times between segments, s.
    divisions: Vec<f64>,
}

/// What one chart is about.
struct Subject<'a> {
    heading: &'a str,
    axis: &'a str,
    /// From file units to those of the chart.
    factor: f64,
    unit: &'a str,
}

impl Drawing<'_> {
    fn attitude(&self) -> Panel {
        let turns = !self.angles() && self.problem.robot.plane().is_none();
        let names: &[&str] = match (self.problem.robot.plane(), turns) {
            (Some(_), _) => &["base"],
            (None, false) => &["roll", "pitch", "yaw"],
            (None, true) => &["rotation angle"],
        };
        let limits = &self.problem.limits;
        let subject = Subject {
            heading: "Base attitude",
            axis: "Angle (deg)",
            factor: 1f64.to_degrees(),
            unit: "°",
        };
        let mut chart = self.chart(
            &subject,
            names,
            &limited_angles(self.rows),
            &limits.base_attitude,
        );
        if names.len() > 1 {
            let angles: Vec<f64> = base_angles(self.rows)
                .iter()
                .map(|angle| subject.factor * angle)
                .collect();
            let line = Series::line("base angle", &self.rows.t, &angles);
            chart = chart.series(line.colour(Colour::Grey));
        }
        let last = self.rows.t.last().copied().unwrap_or(0.0);
        let mut label = "bound at the end";
        for bound in distinct(&limits.final_base_attitude) {
            let level = bound.to_degrees();
            let line = Series::line(label, &[(1.0 - END) * last, last], &[level; 2]);
            let line = line.named("bound at the end");
            chart = chart.series(line.colour(Colour::Black).width(1.6));
            label = "";
        }
        if let Some(straight) = self.straight {
            let values = limited_angles(straight);
            chart = dotted(chart, straight, names, &values, subject.factor);
        }
        panel(&subject, chart)
    }

    fn displacement(&self) -> Panel {
        let names = &["x", "y", "z"][..self.rows.base_position[0].len()];
        let subject = Subject {
            heading: "Base displacement",
            axis: "Displacement (cm)",
            factor: 100.0,
            unit: " cm",
        };
        let limits = &self.problem.limits.base_position;
        let mut chart = self.chart(&subject, names, &moved(self.rows), limits);
        if let Some(straight) = self.straight {
            chart = dotted(chart, straight, names, &moved(straight), subject.factor);
        }
        panel(&subject, chart)
    }

    fn rate(&self) -> Panel {
        let names: &[&str] = match (self.problem.robot.plane(), self.angles()) {
            (Some(_), _) => &["base"],
            (None, true) => &["roll", "pitch", "yaw"],
            (None, false) => &["ω₁", "ω₂", "ω₃"],
        };
        let subject = Subject {
            heading: "Base rate",
            axis: "Rate (deg/s)",
            factor: 1f64.to_degrees(),
            unit: "°/s",
        };
        let limits = &self.problem.limits.base_rate;
        panel(
            &subject,
            self.chart(&subject, names, &self.rows.base_rate, limits),
        )
    }

    /// Positions, rates, controls and torques of the joints of one kind.
    fn joints(&self, kind: JointKind) -> Vec<Panel> {
        let joints = self.problem.robot.joints();
        let chosen: Vec<usize> = (0..joints.len())
            .filter(|&j| joints[j].kind == kind)
            .collect();
        if chosen.is_empty() {
            return Vec::new();
        }
        let names: Vec<&str> = chosen.iter().map(|&j| joints[j].name.as_str()).collect();
        let (rows, limits) = (self.rows, &self.problem.limits);
        let degrees = 1f64.to_degrees();
        let quantities = match kind {
            JointKind::Revolute => [
                ("Joint angles", "Angle (deg)", degrees, "°"),
                ("Joint rates", "Rate (deg/s)", degrees, "°/s"),
                ("Controls u", "Acceleration (deg/s²)", degrees, "°/s²"),
                ("Joint torques", "Torque (N·m)", 1.0, " N·m"),
            ],
            JointKind::Prismatic => [
                ("Sliding joints", "Position (cm)", 100.0, " cm"),
                ("Sliding rates", "Rate (cm/s)", 100.0, " cm/s"),
                ("Controls u, sliding", "Acceleration (m/s²)", 1.0, " m/s²"),
                ("Joint forces", "Force (N)", 1.0, " N"),
            ],
        };
        let values = [
            (&rows.joint_position, &limits.joint_position),
            (&rows.joint_velocity, &limits.joint_velocity),
            (&rows.control, &limits.control),
            (&rows.joint_torque, &limits.torque),
        ];
        let chosen_of = |row: &Vec<f64>| chosen.iter().map(|&j| row[j]).collect();
        let each = quantities.into_iter().zip(values);
        each.map(|((heading, axis, factor, unit), (values, limits))| {
            let subject = Subject {
                heading,
                axis,
                factor,
                unit,
            };
            let values: Vec<Vec<f64>> = values.iter().map(chosen_of).collect();
            let limits: Vec<Interval> = chosen
                .iter()
                .filter_map(|&j| limits.get(j).copied())
                .collect();
            panel(&subject, self.chart(&subject, &names, &values, &limits))
        })
        .collect()
    }

    /// Every column of `values` over time, with the limits.
    fn chart(
        &self,
        subject: &Subject<'_>,
        names: &[&str],
        values: &[Vec<f64>],
        limits: &[Interval],
    ) -> Chart {
        let mut chart = Chart::new(Axis::linear("Time (s)"), Axis::linear(subject.axis))
            .divisions(&self.divisions);
        for (i, name) in names.iter().enumerate() {
            let column: Vec<f64> = values.iter().map(|row| subject.factor * row[i]).collect();
            chart = chart.series(Series::line(name, &self.rows.t, &column));
        }
        if limits.iter().any(|limit| *limit != limits[0]) {
            return matched(chart, subject, names, limits);
        }
        let bounds: Vec<f64> = distinct(limits)
            .iter()
            .map(|bound| subject.factor * bound)
            .collect();
        match bounds[..] {
            [] => chart,
            [low, high] if low == -high => {
                chart.bounds(&format!("limit ±{}{}", short(high), subject.unit), &bounds)
            }
            [_, _] if names.len() == 1 => chart.bounds("limits", &bounds),
            _ => chart.bounds("limit", &bounds),
        }
    }

    fn angles(&self) -> bool {
        self.rows.attitude.is_none_or(|by| by.is_angles())
    }
}

fn panel(subject: &Subject<'_>, chart: Chart) -> Panel {
    Panel {
        heading: subject.heading.into(),
        figure: Figure::new(&format!("{} over time", subject.heading), Width::Column).panel(chart),
        over_time: true,
    }
}

/// Five significant digits at most.
pub(super) fn short(value: f64) -> String {
    rounded(value, 5).to_string()
}

/// Finite bounds, each once, in order.
fn distinct(limits: &[Interval]) -> Vec<f64> {
    let both = limits.iter().flat_map(|limit| [limit.lower, limit.upper]);
    let mut bounds: Vec<f64> = both.filter(|bound| bound.is_finite()).collect();
    bounds.sort_by(f64::total_cmp);
    bounds.dedup();
    bounds
}

/// The chart with limits that differ from series to series: in the colours of the series, or where
/// several have the same, with their names.
fn matched(mut chart: Chart, subject: &Subject<'_>, names: &[&str], limits: &[Interval]) -> Chart {
    let mut groups: Vec<(Interval, Vec<usize>)> = Vec::new();
    for (i, limit) in limits
        .iter()
        .enumerate()
        .filter(|(_, limit)| !limit.is_free())
    {
        match groups.iter_mut().find(|(held, _)| held == limit) {
            Some((_, holders)) => holders.push(i),
            None => groups.push((*limit, vec![i])),
        }
    }
    let drawn = |(limit, holders): &(Interval, Vec<usize>)| -> Vec<(f64, Colour)> {
        let colour = match holders[..] {
            [i] => Colour::of_series(i),
            _ => Colour::Grey,
        };
        let finite = [limit.lower, limit.upper]
            .into_iter()
            .filter(|bound| bound.is_finite());
        finite
            .map(|bound| (subject.factor * bound, colour))
            .collect()
    };
    if groups.len() > 1 && groups.iter().all(|(_, holders)| holders.len() == 1) {
        let bounds: Vec<_> = groups.iter().flat_map(drawn).collect();
        return chart.coloured_bounds("limits, each in its colour", &bounds);
    }
    for group in &groups {
        let held: Vec<&str> = group.1.iter().map(|i| names[*i]).collect();
        let label = format!("limit of {}", held.join(", "));
        chart = chart.coloured_bounds(&label, &drawn(group));
    }
    chart
}

/// The chart with the motion along the straight joint path.
fn dotted(
    mut chart: Chart,
    motion: &Trajectory,
    names: &[&str],
    values: &[Vec<f64>],
    factor: f64,
) -> Chart {
    for i in 0..values.first().map_or(0, Vec::len) {
        let column: Vec<f64> = values.iter().map(|row| factor * row[i]).collect();
        let label = if i == 0 { "straight joint path" } else { "" };
        let name = names.get(i).copied().unwrap_or_default();
        let line = Series::line(label, &motion.t, &column);
        let line = line.named(&format!("straight joint path, {name}"));
        let colour = match values[0].len() {
            1 => Colour::Grey,
            _ => Colour::of_series(i),
        };
        chart = chart.series(line.colour(colour).stroke(Stroke::Dotted));
    }
    chart
}

/// Base positions from where it started, m.
fn moved(motion: &Trajectory) -> Vec<Vec<f64>> {
    let start = &motion.base_position[0];
    let from = |row: &Vec<f64>| row.iter().zip(start).map(|(a, b)| a - b).collect();
    motion.base_position.iter().map(from).collect()
}

/// How close the collocation points of the final mesh stand.
fn points(plan: &Discretization) -> Panel {
    let edges: Vec<f64> = plan
        .mesh
        .breakpoints()
        .iter()
        .map(|fraction| fraction * plan.duration)
        .collect();
    let counts = plan.mesh.points_per_segment();
    let levels: Vec<f64> = counts.iter().map(|&count| count as f64).collect();
    let most = levels.iter().copied().fold(1.0, f64::max);
    let axis = Axis::linear("Points in the segment").range(0.0, 1.15 * most);
    let chart = Chart::new(Axis::linear("Time (s)"), axis)
        .series(Series::steps("", &edges, &levels).named("points"))
        .divisions(&edges[1..edges.len() - 1]);
    let heading = "Final mesh";
    Panel {
        heading: heading.into(),
        figure: Figure::new("Collocation points in every segment", Width::Column).panel(chart),
        over_time: true,
    }
}

/// Errors of every mesh beside the tolerance; `None` where nothing was refined.
fn errors(solution: &Solution) -> Option<Panel> {
    let records = &solution.iterations;
    if records.is_empty() {
        return None;
    }
    let number: Vec<f64> = (1..=records.len()).map(|k| k as f64).collect();
    let ticks: Vec<(f64, String)> = number.iter().map(|k| (*k, format!("{k:.0}"))).collect();
    let of = |value: fn(&Iteration) -> f64| records.iter().map(value).collect::<Vec<_>>();
    let line =
        |label: &str, values: &[f64], marker| Series::line(label, &number, values).marker(marker);
    let mesh = Axis::linear("Mesh")
        .range(0.7, records.len() as f64 + 0.3)
        .ticks(&ticks);
    let chart = Chart::new(mesh, Axis::log("Error"))
        .series(line(
            "largest error (28)",
            &of(|r| r.max_error),
            Marker::Disc,
        ))
        .series(line(
            "by quadrature on a finer LGR set",
            &of(|r| r.quadrature_error),
            Marker::Ring,
        ))
        .bounds("tolerance", &[solution.tolerance]);
    Some(Panel {
        heading: "Errors, mesh by mesh".into(),
        figure: Figure::new("Errors of every mesh", Width::Column).panel(chart),
        over_time: false,
    })
}
