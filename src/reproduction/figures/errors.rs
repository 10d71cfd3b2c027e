//! Figure 3: error of every state in every segment at each mesh iteration.
//!
//! Over time the segments of a layer, some 10 ms of 20 s, would be no wider than a line. All segments
//! are drawn equally wide instead, with the times of their boundaries below.

use super::Case;
use crate::numeric::largest_or_nan;
use crate::plot::{Axis, Chart, Colour, Figure, Series, Width};
use crate::refine::Record;

/// Most labels below a panel.
const LABELS: usize = 9;
/// Ordinal numbers of the paper's sub-captions.
const ORDINALS: [&str; 6] = ["first", "second", "third", "fourth", "fifth", "sixth"];

/// One panel a mesh iteration.
pub fn errors(case: &Case) -> Figure {
    let records = &case.iterations;
    let tolerance = case.problem.mesh.tolerance;
    let n = case.problem.robot.joint_count();
    let all = || {
        records
            .iter()
            .flat_map(|r| r.segment_errors.iter().flatten())
    };
    let top = all().copied().fold(tolerance, f64::max);
    let description = format!(
        "Error of every state at each mesh iteration, {} case",
        case.name
    );
    let mut figure = Figure::new(&description, Width::Page).columns(2);
    for (k, record) in records.iter().enumerate() {
        let edges: Vec<f64> = (0..record.breakpoints.len()).map(|k| k as f64).collect();
        // Errors far below the tolerance say nothing.
        let axis = Axis::log("Error (28)").range(1e-4 * tolerance, 2.0 * top);
        let letter = char::from(b'a' + (k % 26) as u8);
        let ordinal = ORDINALS.get(k).copied().unwrap_or("next");
        let boundaries = Axis::linear("Boundaries of the segments (s)")
            .range(0.0, record.segments as f64)
            .ticks(&times(record, case.trajectory.duration));
        let mut chart = Chart::new(boundaries, axis)
            .title(&format!(
                "({letter}) The {ordinal} iteration: {} points, {}",
                record.points, case.name
            ))
            .divisions(&edges[1..edges.len() - 1])
            .bounds("tolerance", &[tolerance]);
        let angles = record.segment_errors.first().map_or(0, Vec::len) - 2 * n;
        for state in 0..angles + 2 * n {
            let levels: Vec<f64> = record.segment_errors.iter().map(|e| e[state]).collect();
            let mut series = Series::steps(&name(state, angles, n), &edges, &levels);
            if state < angles {
                series = series.colour(Colour::Black);
            }
            chart = chart.series(series);
        }
        figure = figure.panel(chart.height(95.0));
    }
    figure
}

/// Labels of boundaries, as many as have room.
fn times(record: &Record, duration: f64) -> Vec<(f64, String)> {
    let last = record.segments;
    let every = last.div_ceil(LABELS).max(1);
    let label = |k: usize| {
        let text = format!("{:.3}", record.breakpoints[k] * duration);
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    };
    let shown = |k: usize| k.is_multiple_of(every) && k + every <= last || k == last;
    (0..=last)
        .map(|k| (k as f64, if shown(k) { label(k) } else { String::new() }))
        .collect()
}

fn name(state: usize, angles: usize, joints: usize) -> String {
    match state.checked_sub(angles) {
        None => "base".into(),
        Some(j) if j < joints => format!("θ{}", subscript(j + 1)),
        Some(j) => format!("θ̇{}", subscript(j - joints + 1)),
    }
}

fn subscript(number: usize) -> String {
    let digit = |c: char| char::from_u32(0x2080 + c.to_digit(10).unwrap_or(0)).unwrap_or(c);
    number.to_string().chars().map(digit).collect()
}

/// Largest error of a mesh iteration, and the middle of its segment, s.
pub fn worst(record: &Record, duration: f64) -> (f64, f64) {
    let error = |s: usize| largest_or_nan(record.segment_errors[s].iter().copied());
    let s = (0..record.segments)
        .max_by(|&a, &b| error(a).total_cmp(&error(b)))
        .unwrap_or(0);
    let ends = [record.breakpoints[s], record.breakpoints[s + 1]];
    (error(s), 0.5 * duration * (ends[0] + ends[1]))
}
