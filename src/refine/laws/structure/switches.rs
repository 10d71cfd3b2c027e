//! Where controls switch: from their values at the points, and from jumps that the mesh is too coarse
//! for.

use super::ringing;
use crate::ocp::Interval;
use crate::refine::{Assessment, Facts};
use crate::transcription::Discretization;

/// Part of its range by which a control is away from a bound that it counts as being on.
const NEAR: f64 = 0.02;
/// Fewest points in a row that make an arc on a bound.
const LEAST_RUN: usize = 2;
/// Most points in a row between two arcs on different bounds that are one switch.
const MOST_BETWEEN: usize = 2;
/// Part of their windows within which switches are one.
const SAME: f64 = 0.25;
/// Points of an arc inside after which a control that has left a bound has settled.
const SETTLED: usize = 2;
/// Window of the end of a layer, as multiples of its estimate.
const LEAST_LAYER: f64 = 0.05;
const MOST_LAYER: f64 = 4.0;
/// Part of its window that a switch keeps from the ends of it to begin with.
const WITHIN: f64 = 0.05;
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

/// What can be on a bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum What {
    Control(usize),
    Row(usize),
}

/// A control or a row on a bound, from one instant to another, fractions of the duration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Arc {
    pub what: What,
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
    let mut found = Found::default();
    let mut layers = Found::default();
    for signal in signals(assessment.solution, facts) {
        let runs = runs(&signal);
        if any_rings(assessment.solution, &signal, &runs) {
            return Found::default();
        }
        of_values(assessment.solution, &signal, &runs, &mut found);
        let inside = |run: Option<&Run>| run.is_some_and(|run| run.side == 0);
        let What::Control(control) = signal.what else {
            continue;
        };
        let bounded = signal.bounds.lower.is_finite() && signal.bounds.upper.is_finite();
        let may_jump = bounded && !facts.curved[control];
        if may_jump && inside(runs.first()) {
            layer(assessment, facts, control, false, &mut layers);
        }
        if may_jump && inside(runs.last()) {
            layer(assessment, facts, control, true, &mut layers);
        }
    }
    together(&mut found);
    found.switches.append(&mut layers.switches);
    found.arcs.append(&mut layers.arcs);
    found.switches.sort_by(|a, b| a.at.total_cmp(&b.at));
    found
}

/// Whether `signal` rings in one of its `runs` inside.
fn any_rings(solution: &Discretization, signal: &Signal, runs: &[Run]) -> bool {
    let near = NEAR * signal.range();
    let mesh = &solution.mesh;
    let segment = |k: usize| (0..mesh.segments()).rfind(|&s| mesh.start(s) <= k);
    runs.iter().filter(|run| run.side == 0).any(|run| {
        let spans = segment(run.last).zip(segment(run.first));
        let segments = spans.map_or(0, |(last, first)| last - first + 1);
        ringing::rings(&signal.values[run.first..=run.last], segments, near)
    })
}

/// A control or a row with its bounds and its values at the points.
struct Signal {
    what: What,
    bounds: Interval,
    values: Vec<f64>,
}

impl Signal {
    /// The size that closeness to a bound is a part of.
    fn range(&self) -> f64 {
        let all = || self.values.iter().copied();
        let width = self.bounds.upper - self.bounds.lower;
        match width.is_finite() {
            true => width,
            false => all().fold(f64::MIN, f64::max) - all().fold(f64::MAX, f64::min),
        }
    }
}

/// Controls and rows that depend on controls, as far as they have bounds.
fn signals(solution: &Discretization, facts: &Facts<'_>) -> Vec<Signal> {
    let formulation = facts.formulation;
    let points = 0..solution.mesh.points();
    let times = solution.times();
    let controls = formulation.controls.iter().enumerate().map(|(j, control)| {
        let values = points.clone().map(|k| solution.control(k)[j]);
        (What::Control(j), control.bounds, values.collect::<Vec<_>>())
    });
    let jumping = facts.jumping_rows.iter().any(|&jumps| jumps);
    let rows: Vec<Vec<f64>> = match jumping {
        false => Vec::new(),
        true => points
            .clone()
            .map(|k| {
                let (x, u) = (solution.state(k), solution.control(k));
                facts.rates(solution, x, u, times[k]).1
            })
            .collect(),
    };
    let paths = formulation.path.iter().enumerate();
    let paths = paths.filter(|(p, _)| facts.jumping_rows[*p]);
    let paths = paths.map(|(p, row)| {
        let values = rows.iter().map(|row| row[p]).collect();
        (What::Row(p), row.bounds, values)
    });
    controls
        .chain(paths)
        .filter(|(_, bounds, _)| !bounds.is_free() && !bounds.is_fixed())
        .map(|(what, bounds, values)| Signal {
            what,
            bounds,
            values,
        })
        .collect()
}

/// Makes one of switches so near each other that the mesh does not tell them apart.
fn together(found: &mut Found) {
    found.switches.sort_by(|a, b| a.at.total_cmp(&b.at));
    let mut groups: Vec<Vec<Switch>> = Vec::new();
    for switch in std::mem::take(&mut found.switches) {
        let width = switch.window.upper - switch.window.lower;
        match groups.last_mut() {
            Some(group) if switch.at - group[0].at < SAME * width => group.push(switch),
            _ => groups.push(vec![switch]),
        }
    }
    for group in groups {
        let at = group.iter().map(|s| s.at).sum::<f64>() / group.len() as f64;
        let bound = |pick: fn(&Switch) -> f64, better: fn(f64, f64) -> f64, from: f64| {
            group.iter().map(pick).fold(from, better)
        };
        let lower = bound(|s| s.window.lower, f64::min, 1.0);
        let upper = bound(|s| s.window.upper, f64::max, 0.0);
        for arc in &mut found.arcs {
            for end in [&mut arc.from, &mut arc.to] {
                if group.iter().any(|s| s.at == *end) {
                    *end = at;
                }
            }
        }
        found.switches.push(Switch {
            at,
            window: Interval::new(lower, upper),
        });
    }
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

/// Runs of `signal`, those too short to tell anything being part of what is beside them.
fn runs(signal: &Signal) -> Vec<Run> {
    let near = NEAR * signal.range();
    let bounds = &signal.bounds;
    let each = signal.values.iter().enumerate().map(|(k, &u)| {
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
fn of_values(solution: &Discretization, signal: &Signal, runs: &[Run], found: &mut Found) {
    let (bounds, values) = (&signal.bounds, &signal.values);
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
                        let part = |k: usize| weights[k] * (values[k] - b);
                        let between: f64 = (run.last + 1..next.first).map(part).sum();
                        ends[run.last + 1] + between / (a - b)
                    }
                    false => left(&ends, &weights, values, &run, next),
                };
                let window = window(run.last, next.first);
                let room = WITHIN * (window.upper - window.lower);
                let at = at.clamp(window.lower + room, window.upper - room);
                found.switches.push(Switch { at, window });
                at
            }
        };
        if run.side != 0 {
            found.arcs.push(Arc {
                what: signal.what,
                value: value(run.side),
                from,
                to,
            });
        }
        from = to;
        i += 1 + skip;
    }
}

/// When a bound is left, or reached: as if the values beside it were those of a jump to where they
/// settle, which is late or early by less than two points where there is none.
fn left(ends: &[f64], weights: &[f64], values: &[f64], run: &Run, next: &Run) -> f64 {
    let here = ends[run.last + 1];
    let inner = if run.side == 0 { run } else { next };
    if inner.last + 1 - inner.first <= 2 * SETTLED {
        return here;
    }
    if run.side != 0 {
        let (a, b) = (values[run.last], values[next.first + SETTLED]);
        let points = next.first..next.first + SETTLED;
        let sum: f64 = points.map(|k| weights[k] * (values[k] - b)).sum();
        here + sum / (a - b)
    } else {
        let (a, b) = (values[run.last - SETTLED], values[next.first]);
        let points = run.last + 1 - SETTLED..run.last + 1;
        let sum: f64 = points.map(|k| weights[k] * (values[k] - a)).sum();
        here - sum / (b - a)
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
        facts.rates(solution, x, &u, t).0
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
    let (a, b) = (
        end + sign * LEAST_LAYER * width,
        end + sign * MOST_LAYER * width,
    );
    found.switches.push(Switch {
        at,
        window: Interval::new(a.min(b), a.max(b)),
    });
    found.arcs.push(Arc {
        what: What::Control(control),
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
