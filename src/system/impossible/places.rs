//! Places of the task that a limit forbids: pairs that overlap, a base that turns too fast from the
//! start, an attitude at t_f outside of the range along the path.

use crate::dynamics::space::Space;
use crate::ocp::{Interval, Ocp, Point};
use crate::problem::{Impossible, LimitId, Place, Problem};
use crate::system::free_floating::FreeFloating;
use crate::system::rows::{Component, Row};

/// Part of its size by which a row may exceed its bounds: rounding, of the file as well.
const ROOM: f64 = 1e-6;

pub(super) fn reasons<Sp: Space>(problem: &Problem, system: &FreeFloating<Sp>) -> Vec<Impossible> {
    let task = &problem.task;
    let mut found = Vec::new();
    let start = values(system, &task.initial_joints, &task.initial_rates);
    found.extend(overlaps(problem, system, Place::Start, &start));
    for (i, point) in task.way_points.iter().enumerate() {
        let joints: Option<Vec<f64>> = point.joints.iter().copied().collect();
        if let Some(joints) = joints {
            let there = values(system, &joints, &vec![0.0; joints.len()]);
            found.extend(overlaps(problem, system, Place::WayPoint(i), &there));
        }
    }
    if !task.free_joints.contains(&true) {
        let goal = values(system, &task.final_joints, &vec![0.0; system.joint_count()]);
        found.extend(overlaps(problem, system, Place::Goal, &goal));
    }
    found.extend(base_rates(problem, system, &start));
    found.extend(final_attitudes(problem));
    found
}

/// Values of the path rows at these joint positions and rates; the base as at the start.
fn values<Sp: Space>(system: &FreeFloating<Sp>, joints: &[f64], rates: &[f64]) -> Vec<f64> {
    let x = [system.start_attitude(), joints, rates].concat();
    let u = vec![0.0; joints.len()];
    let mut rows = vec![0.0; system.path_rows().len()];
    let mut derivatives = vec![0.0; x.len()];
    // No place is forbidden by a peak, whatever it is.
    let peaks = vec![1.0; system.formulation.parameters.len()];
    let point = Point {
        x: &x,
        u: &u,
        t: 0.0,
        parameters: &peaks,
    };
    let mut scratch = system.scratch::<f64>();
    system.continuous(point, &mut scratch, &mut derivatives, &mut rows);
    rows
}

/// The pairs that overlap; their clearance is a function of the joint positions alone.
fn overlaps<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    place: Place,
    values: &[f64],
) -> Vec<Impossible> {
    exceeded(system, LimitId::KeepOut, values)
        .filter_map(|(row, value)| match row.id.component {
            Component::Pair(pair) => Some(Impossible::NotApart {
                pair,
                name: problem.limits.keep_out[pair].name.clone(),
                place,
                overlap: -value,
            }),
            _ => None,
        })
        .collect()
}

/// The base's rates at the start that exceed their limit.
fn base_rates<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    values: &[f64],
) -> Vec<Impossible> {
    let count = problem.limits.base_rate.len();
    exceeded(system, LimitId::BaseRate, values)
        .filter_map(|(row, rate)| match row.id.component {
            Component::Attitude(i) | Component::Axis(i) => Some(Impossible::BaseRate {
                component: [i, count],
                name: row.quantity.name.clone(),
                rate,
                bound: row.quantity.bounds,
            }),
            _ => None,
        })
        .collect()
}

/// The rows of `limit` whose value is outside of their bounds.
fn exceeded<'a, Sp: Space>(
    system: &'a FreeFloating<Sp>,
    limit: LimitId,
    values: &'a [f64],
) -> impl Iterator<Item = (&'a Row, f64)> {
    let rows = system.path_rows().iter().zip(values.iter().copied());
    rows.filter(move |(row, value)| {
        let excess = row.quantity.bounds.violation(*value);
        row.id.limit == limit && excess > ROOM * row.size.max(value.abs())
    })
}

/// The ranges of the base attitude at t_f that nothing along the path meets.
fn final_attitudes(problem: &Problem) -> Vec<Impossible> {
    let limits = &problem.limits;
    let ends = &limits.final_base_attitude;
    let pairs = ends.iter().zip(&limits.base_attitude).enumerate();
    let apart = |a: &Interval, b: &Interval| a.lower > b.upper || b.lower > a.upper;
    pairs
        .filter(|(_, (at_end, along))| apart(at_end, along))
        .map(|(i, (at_end, along))| Impossible::FinalBaseAttitude {
            component: [i, ends.len()],
            at_end: *at_end,
            along: *along,
        })
        .collect()
}
