//! Where a trajectory goes: the range of every quantity, and which bounds lie far outside it.

use super::Discretization;
use crate::ocp::{DynOcp, Formulation, InteriorPoint, Interval, Quantity};

/// A bound this many times as large as anything on the way to it cannot act.
const FAR: f64 = 1e4;

/// Ranges of all quantities along a trajectory, at its nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranges {
    pub(super) states: Vec<Interval>,
    pub(super) controls: Vec<Interval>,
    pub(super) path: Vec<Interval>,
    pub(super) boundary: Vec<Interval>,
    /// Of each way-point, the values of its rows.
    pub(super) way_points: Vec<Vec<Interval>>,
    pub(super) parameters: Vec<Interval>,
    pub(super) integrals: Vec<Interval>,
    pub(super) initial_time: f64,
    pub(super) duration: f64,
}

const NOWHERE: Interval = Interval::new(f64::INFINITY, f64::NEG_INFINITY);

impl Ranges {
    /// That of `trajectory`, which has a node at every way-point.
    pub fn of(ocp: &dyn DynOcp, formulation: &Formulation, trajectory: &Discretization) -> Self {
        let (n, m) = formulation.widths();
        let mut found = Self {
            states: vec![NOWHERE; n],
            controls: vec![NOWHERE; m],
            path: vec![NOWHERE; formulation.path.len()],
            boundary: vec![NOWHERE; formulation.boundary.len()],
            way_points: Vec::new(),
            parameters: only(&trajectory.parameters),
            integrals: only(&trajectory.integrals),
            initial_time: trajectory.initial_time,
            duration: trajectory.duration,
        };
        let mut functions = ocp.functions();
        let (mut rates, mut path) = (vec![0.0; n], vec![0.0; formulation.path.len()]);
        let times = trajectory.times();
        let points = trajectory.mesh.points();
        for (k, &t) in times.iter().enumerate() {
            let x = trajectory.state(k);
            widen(&mut found.states, x);
            if k < points {
                let u = trajectory.control(k);
                widen(&mut found.controls, u);
                let point = trajectory.point(x, u, t);
                functions.continuous(point, &mut rates, &mut path);
                widen(&mut found.path, &path);
            }
        }
        let mut rows = vec![0.0; formulation.boundary.len()];
        functions.boundary(trajectory.ends(), &mut rows);
        widen(&mut found.boundary, &rows);
        for (way_point, point) in formulation.way_points.iter().enumerate() {
            let mut ranges = vec![NOWHERE; point.rows.len()];
            if let Some(node) = trajectory.mesh.node_at(point.fraction) {
                let mut rows = vec![0.0; point.rows.len()];
                let passed = InteriorPoint {
                    way_point,
                    x: trajectory.state(node),
                    parameters: &trajectory.parameters,
                    t: times[node],
                };
                functions.way_point(passed, &mut rows);
                widen(&mut ranges, &rows);
            }
            found.way_points.push(ranges);
        }
        found
    }

    /// `formulation` without the bounds that lie far outside this.
    ///
    /// Left in, they would spoil what is made of bounds: the solver keeps its distance from each,
    /// begins with a multiplier for each and waits for all products of the two to become small.
    pub fn without_far_bounds(&self, formulation: &Formulation) -> Formulation {
        let mut near = formulation.clone();
        let ends = Typed::of(formulation);
        for (i, state) in near.states.iter_mut().enumerate() {
            let size = magnitude(&self.states[i]).max(ends.0[i]);
            let size = reachable(state, size);
            drop_far(&mut state.bounds, size);
            let instants = near.way_points.iter_mut().map(|point| &mut point.states[i]);
            let all = instants.chain([&mut near.initial[i], &mut near.terminal[i]]);
            all.for_each(|bounds| drop_far(bounds, size));
        }
        let rows = near.way_points.iter_mut().zip(&self.way_points);
        let rows = rows.flat_map(|(point, ranges)| point.rows.iter_mut().zip(ranges));
        let others = near.controls.iter_mut().zip(&self.controls);
        let others = others.chain(near.path.iter_mut().zip(&self.path));
        let others = others.chain(near.boundary.iter_mut().zip(&self.boundary));
        let others = others.chain(near.parameters.iter_mut().zip(&self.parameters));
        let others = others.chain(near.integrals.iter_mut().zip(&self.integrals));
        for (quantity, range) in others.chain(rows) {
            let size = reachable(quantity, magnitude(range));
            drop_far(&mut quantity.bounds, size);
        }
        drop_far(&mut near.duration, self.duration);
        let time = self.duration.max(self.initial_time.abs());
        drop_far(&mut near.initial_time, time);
        near
    }

    /// Whether a bound of `formulation` that `near` does not have is exceeded.
    pub fn exceeds_dropped(&self, formulation: &Formulation, near: &Formulation) -> bool {
        let pairs = formulation
            .states
            .iter()
            .zip(&near.states)
            .zip(&self.states);
        let pairs = pairs
            .chain(
                formulation
                    .controls
                    .iter()
                    .zip(&near.controls)
                    .zip(&self.controls),
            )
            .chain(formulation.path.iter().zip(&near.path).zip(&self.path))
            .chain(
                formulation
                    .boundary
                    .iter()
                    .zip(&near.boundary)
                    .zip(&self.boundary),
            )
            .chain(
                formulation
                    .parameters
                    .iter()
                    .zip(&near.parameters)
                    .zip(&self.parameters),
            )
            .chain(
                formulation
                    .integrals
                    .iter()
                    .zip(&near.integrals)
                    .zip(&self.integrals),
            );
        let instants = formulation.way_points.iter().zip(&near.way_points);
        let rows = instants
            .zip(&self.way_points)
            .flat_map(|((all, near), ranges)| all.rows.iter().zip(&near.rows).zip(ranges));
        let of_quantities = pairs
            .chain(rows)
            .any(|((all, near), range)| beyond(&all.bounds, &near.bounds, range));
        // The bounds of a state at one instant are those of its whole range: a little too careful.
        let n = formulation.states.len();
        let at_instants = (0..n).any(|i| {
            let points = formulation.way_points.iter().zip(&near.way_points);
            points
                .map(|(all, near)| (all.states[i], near.states[i]))
                .chain([
                    (formulation.initial[i], near.initial[i]),
                    (formulation.terminal[i], near.terminal[i]),
                ])
                .any(|(all, near)| beyond(&all, &near, &self.states[i]))
        });
        let [start, duration] = [self.initial_time, self.duration].map(Interval::fixed);
        of_quantities
            || at_instants
            || beyond(&formulation.duration, &near.duration, &duration)
            || beyond(&formulation.initial_time, &near.initial_time, &start)
    }
}

/// Sizes that a formulation itself tells: of each state, the largest value it is fixed to
/// somewhere.
pub(super) struct Typed(pub Vec<f64>);

impl Typed {
    pub fn of(formulation: &Formulation) -> Self {
        let fixed = |bounds: &Interval| match bounds.is_fixed() {
            true => bounds.lower.abs(),
            false => 0.0,
        };
        let of_state = |i: usize| {
            let points = formulation.way_points.iter().map(|point| &point.states[i]);
            let ends = [&formulation.initial[i], &formulation.terminal[i]];
            points.chain(ends).map(fixed).fold(0.0, f64::max)
        };
        Self((0..formulation.states.len()).map(of_state).collect())
    }
}

/// The range of each value that there is but one of.
fn only(values: &[f64]) -> Vec<Interval> {
    values.iter().map(|&value| Interval::fixed(value)).collect()
}

fn widen(ranges: &mut [Interval], values: &[f64]) {
    for (range, &value) in ranges.iter_mut().zip(values) {
        // A NaN widens nothing.
        range.lower = range.lower.min(value);
        range.upper = range.upper.max(value);
    }
}

/// The largest finite magnitude in a range; 0 where there is none.
pub(super) fn magnitude(range: &Interval) -> f64 {
    [range.lower.abs(), range.upper.abs()]
        .into_iter()
        .filter(|value| value.is_finite())
        .fold(0.0, f64::max)
}

/// What a quantity of `size` may reach: nothing is known to be small before it is solved for.
fn reachable(quantity: &Quantity, size: f64) -> f64 {
    size.max(quantity.scale.unwrap_or(1.0))
}

fn drop_far(bounds: &mut Interval, size: f64) {
    if bounds.is_fixed() {
        return;
    }
    if bounds.lower < -FAR * size {
        bounds.lower = f64::NEG_INFINITY;
    }
    if bounds.upper > FAR * size {
        bounds.upper = f64::INFINITY;
    }
}

fn beyond(all: &Interval, near: &Interval, range: &Interval) -> bool {
    (near.lower < all.lower && range.lower < all.lower)
        || (near.upper > all.upper && range.upper > all.upper)
}
