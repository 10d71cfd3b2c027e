//! Where controls switch: from their values at the points, and from jumps that the mesh is too coarse
//! for.

use crate::ocp::Interval;
use crate::refine::{Assessment, Facts};
use crate::transcription::Discretization;

/// Part of its range by which a control is away from a bound that it counts as being on.
const NEAR: f64 = 0.02;
/// Fewest points in a row that make an arc on a bound.
const LEAST_RUN: usize = 2;
/// Most points in a row between two arcs on different bounds that are one switch.
const MOST_BETWEEN: usize = 2;
/// Window of the end of a layer, as multiples of its estimate.
const LAYER: (f64, f64) = (0.05, 4.0);
/// Longest layer, as a part of the segment it is in.
const LONGEST_LAYER: f64 = 0.3;
/// A jump is one if it is so many times as large as what the smooth motion beside it leaves.
const CLEAR: f64 = 5.0;

/// An instant at which a control switches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Switch {
    pub at: f64,
    pub window: Interval,
}

/// A control on a bound, from one instant to another, fractions of the duration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Arc {
    pub control: usize,
    pub value: f64,
    pub from: f64,
    pub to: f64,
}

/// Switches and arcs on bounds. An arc begins and ends at an end of the time axis or at a switch.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Found {
    pub switches: Vec<Switch>,
    pub arcs: Vec<Arc>,
}

/// Points `first..=last` in a row on the lower bound (−1), inside (0) or on the upper one (1).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Run {
    side: i8,
    first: usize,
    last: usize,
}

/// The structure of the solution.
pub(super) fn find(assessment: &Assessment<'_>, facts: &Facts<'_>) -> Found {
    let solution = assessment.solution;
    let mut found = Found::default();
    for control in 0..solution.controls {
        let bounds = facts.formulation.controls[control].bounds;
        if !(bounds.lower.is_finite() && bounds.upper.is_finite()) || bounds.is_fixed() {
            continue;
        }
        let runs = runs(solution, control, &bounds);
        of_values(solution, control, &bounds, &runs, &mut found);
        let inside = |run: Option<&Run>| run.is_some_and(|run| run.side == 0);
        if inside(runs.first()) {
            layer(assessment, facts, control, false, &mut found);
        }
        if inside(runs.last()) {
            layer(assessment, facts, control, true, &mut found);
        }
    }
    found.switches.sort_by(|a, b| a.at.total_cmp(&b.at));
    found
}

fn merged(runs: Vec<Run>) -> Vec<Run> {
    let mut merged: Vec<Run> = Vec::new();
    for run in runs {
        match merged.last_mut() {
            Some(last) if last.side == run.side => last.last = run.last,
            _ => merged.push(run),
        }
    }
    merged
}

/// Runs of `control`, those too short to tell anything being part of what is beside them.
fn runs(solution: &Discretization, control: usize, bounds: &Interval) -> Vec<Run> {
    let near = NEAR * (bounds.upper - bounds.lower);
    let each = (0..solution.mesh.points()).map(|k| {
        let u = solution.control(k)[control];
        let side = i8::from(u >= bounds.upper - near) - i8::from(u <= bounds.lower + near);
        Run {
            side,
            first: k,
            last: k,
        }
    });
    let mut runs = merged(each.collect());
    let length = |run: &Run| run.last + 1 - run.first;
    // A point or two on a bound alone are inside.
    for run in &mut runs {
        if run.side != 0 && length(run) < LEAST_RUN {
            run.side = 0;
        }
    }
    runs = merged(runs);
    let last = runs.len() - 1;
    for i in 0..runs.len() {
        if runs[i].side != 0 || length(&runs[i]) > MOST_BETWEEN {
            continue;
        }
        // Few points inside: between the same bound twice, or at an end, they are on it.
        let before = (i > 0).then(|| runs[i - 1].side);
        let after = (i < last).then(|| runs[i + 1].side);
        match (before, after) {
            (Some(a), Some(b)) if a == b => runs[i].side = a,
            (None, Some(b)) => runs[i].side = b,
            (Some(a), None) => runs[i].side = a,
            _ => {}
        }
    }
    merged(runs)
}

/// Switches and arcs that `runs` show.
fn of_values(
    solution: &Discretization,
    control: usize,
    bounds: &Interval,
    runs: &[Run],
    found: &mut Found,
) {
    let value = |side: i8| if side > 0 { bounds.upper } else { bounds.lower };
    let weights = quadrature(solution);
    let mut ends = vec![0.0];
    ends.extend(weights.iter().scan(0.0, |sum, w| {
        *sum += w;
        Some(*sum)
    }));
    let times = solution.mesh.node_fractions();
    let window = |before: usize, after: usize| {
        let earlier = before.saturating_sub(1);
        let later = (after + 1).min(times.len() - 1);
        Interval::new(times[earlier], times[later])
    };
    let mut from = 0.0;
    let mut i = 0;
    while i < runs.len() {
        let run = runs[i];
        // The next arc, beyond a few points between two bounds.
        let between = |next: &&Run| next.side == 0 && next.last - next.first < MOST_BETWEEN;
        let skip = usize::from(run.side != 0 && runs.get(i + 1).filter(between).is_some());
        let next = runs.get(i + 1 + skip);
        let to = match next {
            None => 1.0,
            Some(next) => {
                let at = match run.side != 0 && next.side != 0 {
                    true => {
                        // The impulse of the points between is that of a jump.
                        let (a, b) = (value(run.side), value(next.side));
                        let part = |k: usize| weights[k] * (solution.control(k)[control] - b);
                        let between: f64 = (run.last + 1..next.first).map(part).sum();
                        ends[run.last + 1] + between / (a - b)
                    }
                    false => ends[run.last + 1],
                };
                let window = window(run.last, next.first);
                let room = 0.05 * (window.upper - window.lower);
                let at = at.clamp(window.lower + room, window.upper - room);
                found.switches.push(Switch { at, window });
                at
            }
        };
        if run.side != 0 {
            found.arcs.push(Arc {
                control,
                value: value(run.side),
                from,
                to,
            });
        }
        from = to;
        i += 1 + skip;
    }
}

fn quadrature(solution: &Discretization) -> Vec<f64> {
    let mesh = &solution.mesh;
    (0..mesh.segments())
        .flat_map(|s| {
            let half = 0.5 * mesh.width(s);
            mesh.rule(s).weights().iter().map(move |w| half * w)
        })
        .collect()
}

/// A layer of `control` at the start, or at the end, shorter than the mesh shows: a state fixed there
/// that is not what the motion inside leads to. The control is on its bound for as long as the jump
/// takes.
fn layer(
    assessment: &Assessment<'_>,
    facts: &Facts<'_>,
    control: usize,
    at_end: bool,
    found: &mut Found,
) {
    let solution = assessment.solution;
    let mesh = &solution.mesh;
    let formulation = facts.formulation;
    let s = if at_end { mesh.segments() - 1 } else { 0 };
    if mesh.segments() < 4 || assessment.errors.worst(s).1 <= assessment.tolerance {
        return;
    }
    let node = if at_end { mesh.points() } else { 0 };
    let fixed = match at_end {
        true => &formulation.terminal,
        false => &formulation.initial,
    };
    let sign = if at_end { -1.0 } else { 1.0 };
    let end = if at_end { 1.0 } else { 0.0 };
    let bounds = &formulation.controls[control].bounds;
    let x = solution.state(node);
    let t = solution.time(end);
    let rates = |value: f64| {
        let mut u: Vec<f64> = solution.control(node.min(mesh.points() - 1)).to_vec();
        u[control] = value;
        facts.rates(solution, x, &u, t)
    };
    let (low, high) = (rates(bounds.lower), rates(bounds.upper));
    let mut best: Option<(f64, f64)> = None;
    for i in (0..solution.states).filter(|&i| fixed[i].is_fixed()) {
        if !facts.drivers[i].contains(&control) {
            continue;
        }
        let Some((value, slope, rest)) = extrapolated(solution, i, at_end) else {
            continue;
        };
        let jump = sign * (value - x[i]);
        if jump.abs() <= CLEAR * rest.max(1e-12) {
            continue;
        }
        for (rate, bound) in [(low[i], bounds.lower), (high[i], bounds.upper)] {
            let closing = solution.duration * rate - slope;
            let width = jump / closing;
            if width > 0.0 && width < LONGEST_LAYER * mesh.width(s) {
                let longer = best.is_none_or(|(longest, _)| width > longest);
                best = if longer { Some((width, bound)) } else { best };
            }
        }
    }
    let Some((width, value)) = best else { return };
    let at = end + sign * width;
    let (a, b) = (end + sign * LAYER.0 * width, end + sign * LAYER.1 * width);
    found.switches.push(Switch {
        at,
        window: Interval::new(a.min(b), a.max(b)),
    });
    found.arcs.push(Arc {
        control,
        value,
        from: end.min(at),
        to: end.max(at),
    });
}

/// Value and slope, a unit of the duration, of state `i` at the start or the end, as a cubic through
/// the second and third segment from there has it, and what that leaves.
fn extrapolated(solution: &Discretization, i: usize, at_end: bool) -> Option<(f64, f64, f64)> {
    let mesh = &solution.mesh;
    let last = mesh.segments();
    let (first, end) = match at_end {
        true => (mesh.start(last - 3), mesh.start(last - 1)),
        false => (mesh.start(1), mesh.start(3)),
    };
    let times = mesh.node_fractions();
    let origin = if at_end { 1.0 } else { 0.0 };
    let rows = end - first + 1;
    let size = (times[end] - times[first]).max(f64::MIN_POSITIVE);
    let matrix = nalgebra::DMatrix::from_fn(rows, 4, |r, c| {
        ((times[first + r] - origin) / size).powi(c as i32)
    });
    let values = nalgebra::DVector::from_fn(rows, |r, _| solution.state(first + r)[i]);
    let fit = matrix.clone().svd(true, true).solve(&values, 1e-12).ok()?;
    let rest = (&matrix * &fit - &values).amax();
    Some((fit[0], fit[1] / size, rest))
}
