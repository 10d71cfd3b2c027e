//! Carries a solution, primal and dual, from one mesh to another.
//!
//! Derived in docs/algorithms.md#transfer-between-meshes.

use crate::collocation::Mesh;
use crate::nlp::Iterate;
use crate::transcription::{Discretization, Layout};

/// Multipliers of a programme seen as functions of time, on the mesh they were found on.
///
/// The multiplier of a defect is the quadrature weight w times a costate. That of a path row or of
/// a bound along the path is w·(width/2) times a density in time. Costates and densities do not
/// depend on the mesh, so that they can be evaluated at the points of another one. Between points
/// they are interpolated linearly: they jump where a limit becomes active, and a polynomial would
/// ring there. Costates jump at way-points too, and no interpolation goes across one.
pub(super) struct Duals<'a> {
    layout: &'a Layout,
    iterate: &'a Iterate,
    /// Fractions of the duration of the points.
    times: Vec<f64>,
    weights: Vec<Weight>,
    /// The first point of each phase, and the number of all points. Phases lie between the ends
    /// and the way-points.
    phases: Vec<usize>,
}

/// What the multipliers of one point are divided by to become functions of time.
#[derive(Debug, Clone, Copy)]
struct Weight {
    /// w, for a defect.
    defect: f64,
    /// w·(width/2), for path rows and bounds.
    density: f64,
}

fn weights(mesh: &Mesh) -> Vec<Weight> {
    (0..mesh.segments())
        .flat_map(|s| {
            let half = 0.5 * mesh.width(s);
            let weight = move |&w: &f64| Weight {
                defect: w,
                density: w * half,
            };
            mesh.rule(s).weights().iter().map(weight)
        })
        .collect()
}

/// Two neighbouring points with an instant between them.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Bracket {
    left: usize,
    right: usize,
    /// How far the instant is from the left point to the right one, 0 to 1.
    share: f64,
}

impl Bracket {
    /// The neighbours among `times` of `fraction`; an end of `times` beyond it.
    fn of(times: &[f64], fraction: f64) -> Self {
        let last = times.len() - 1;
        let right = times.partition_point(|&t| t < fraction).min(last);
        let left = right.saturating_sub(1);
        let gap = times[right] - times[left];
        let share = if gap > 0.0 {
            (fraction - times[left]) / gap
        } else {
            1.0
        };
        Self {
            left,
            right,
            share: share.clamp(0.0, 1.0),
        }
    }

    /// Linear interpolation between the values at both points.
    fn interpolate(&self, value: impl Fn(usize) -> f64) -> f64 {
        (1.0 - self.share) * value(self.left) + self.share * value(self.right)
    }
}

/// A point of another mesh, as the multipliers there need it.
#[derive(Debug, Clone, Copy)]
struct Target {
    point: usize,
    weight: Weight,
    /// Its neighbours on the old mesh.
    bracket: Bracket,
}

impl<'a> Duals<'a> {
    /// The multipliers in `iterate`, which belong to `mesh` and `layout`.
    pub fn new(mesh: &'a Mesh, layout: &'a Layout, iterate: &'a Iterate) -> Self {
        let mut times = mesh.node_fractions();
        times.pop();
        let nodes = layout.way_point_nodes();
        Self {
            phases: [0].into_iter().chain(nodes).chain([times.len()]).collect(),
            layout,
            iterate,
            times,
            weights: weights(mesh),
        }
    }

    /// The neighbours of `fraction` in its phase.
    fn bracket(&self, fraction: f64) -> Bracket {
        let starts = &self.phases[1..self.phases.len() - 1];
        let phase = starts.partition_point(|&first| self.times[first] <= fraction);
        let (first, end) = (self.phases[phase], self.phases[phase + 1]);
        let bracket = Bracket::of(&self.times[first..end], fraction);
        Bracket {
            left: first + bracket.left,
            right: first + bracket.right,
            ..bracket
        }
    }

    /// A starting iterate on another mesh: `x` with the multipliers of this one.
    pub fn on(&self, mesh: &Mesh, layout: &Layout, x: Vec<f64>) -> Iterate {
        let mut to = Iterate {
            multipliers: vec![0.0; layout.rows()],
            lower_multipliers: vec![0.0; layout.variables()],
            upper_multipliers: vec![0.0; layout.variables()],
            x,
        };
        let mut fractions = mesh.node_fractions();
        fractions.pop();
        for (point, (&fraction, weight)) in fractions.iter().zip(weights(mesh)).enumerate() {
            let target = Target {
                point,
                weight,
                bracket: self.bracket(fraction),
            };
            let from = self.iterate;
            self.set_rows(layout, target, &mut to.multipliers);
            self.set_bounds(
                layout,
                target,
                &from.lower_multipliers,
                &mut to.lower_multipliers,
            );
            self.set_bounds(
                layout,
                target,
                &from.upper_multipliers,
                &mut to.upper_multipliers,
            );
        }
        self.copy_ends(layout, &mut to);
        to
    }

    /// Sets the multipliers of the defects and path rows of a point of another mesh.
    fn set_rows(&self, layout: &Layout, target: Target, out: &mut [f64]) {
        let old = self.layout;
        let from = &self.iterate.multipliers;
        let Target {
            point,
            weight,
            bracket,
        } = target;
        for i in 0..layout.states {
            let costate = |k: usize| from[old.defect(k, i)] / self.weights[k].defect;
            out[layout.defect(point, i)] = weight.defect * bracket.interpolate(costate);
        }
        for p in 0..Self::common(layout.path, old.path) {
            let density = |k: usize| from[old.path(k, p)] / self.weights[k].density;
            out[layout.path(point, p)] = weight.density * bracket.interpolate(density);
        }
    }

    /// Sets the multipliers of the lower or the upper bounds of states and controls at a point of
    /// another mesh, `from` being those of all variables on this one.
    fn set_bounds(&self, layout: &Layout, target: Target, from: &[f64], out: &mut [f64]) {
        let Target {
            point,
            weight,
            bracket,
        } = target;
        for i in 0..layout.states + layout.controls {
            let density = |k: usize| {
                let k = if i < layout.states {
                    self.without_way_point(k)
                } else {
                    k
                };
                from[self.layout.state(k, i)] / self.weights[k].density
            };
            out[layout.state(point, i)] = weight.density * bracket.interpolate(density);
        }
    }

    /// Point `k`, or the next one where `k` is a way-point.
    ///
    /// The bounds of a state at a way-point hold at that instant. Their multipliers are impulses,
    /// not densities in time, so that the density next to them is used.
    fn without_way_point(&self, k: usize) -> usize {
        let is_way_point = self.layout.way_point_nodes().any(|node| node == k);
        (k + usize::from(is_way_point)).min(self.times.len() - 1)
    }

    /// Number of rows whose multipliers are taken over: all, or none where the two problems have
    /// not as many.
    fn common(new: usize, old: usize) -> usize {
        if new == old { new } else { 0 }
    }

    /// Copies the multipliers that belong to one instant, or to the problem as a whole: they have
    /// no weight.
    fn copy_ends(&self, layout: &Layout, to: &mut Iterate) {
        let old = self.layout;
        let nodes = layout.way_point_nodes().zip(old.way_point_nodes());
        for (way_point, (node, from)) in nodes.enumerate() {
            for i in 0..layout.states {
                let (v, w) = (layout.state(node, i), old.state(from, i));
                to.lower_multipliers[v] = self.iterate.lower_multipliers[w];
                to.upper_multipliers[v] = self.iterate.upper_multipliers[w];
            }
            let (row, from) = (layout.way_point(way_point, 0), old.way_point(way_point, 0));
            let rows = layout.defect(node, 0) - row;
            to.multipliers[row..row + rows]
                .copy_from_slice(&self.iterate.multipliers[from..from + rows]);
        }
        let final_states =
            (0..layout.states).map(|i| (layout.state(layout.points, i), old.state(old.points, i)));
        let duration = (layout.free_duration && old.free_duration)
            .then(|| (layout.duration(), old.duration()));
        let start = (layout.free_initial_time && old.free_initial_time)
            .then(|| (layout.initial_time(), old.initial_time()));
        let parameters = (0..Self::common(layout.parameters, old.parameters))
            .map(|i| (layout.parameter(i), old.parameter(i)));
        let integrals = 0..Self::common(layout.integrals, old.integrals);
        let values = integrals
            .clone()
            .map(|i| (layout.integral(i), old.integral(i)));
        let variables = final_states.chain(duration).chain(start);
        for (v, w) in variables.chain(parameters).chain(values) {
            to.lower_multipliers[v] = self.iterate.lower_multipliers[w];
            to.upper_multipliers[v] = self.iterate.upper_multipliers[w];
        }
        let boundary = (0..Self::common(layout.boundary, old.boundary))
            .map(|b| (layout.boundary(b), old.boundary(b)));
        let quadratures = integrals.map(|i| (layout.integral_row(i), old.integral_row(i)));
        let final_time = (layout.bounded_final_time && old.bounded_final_time)
            .then(|| (layout.final_time_row(), old.final_time_row()));
        for (r, s) in boundary.chain(quadratures).chain(final_time) {
            to.multipliers[r] = self.iterate.multipliers[s];
        }
    }
}

/// Layout of the programme that multipliers saved for another problem on the same mesh belong to:
/// states and controls are those of `layout`, path and boundary rows follow from the lengths.
///
/// `None` where no layout has these lengths.
pub(super) fn saved_layout(saved: &Iterate, layout: &Layout) -> Option<Layout> {
    let whole = layout.integrals > 0 || layout.bounded_final_time;
    if whole || layout.way_point_nodes().next().is_some() {
        // The number of rows does not say how many belong to way-points or to the whole: only the
        // same layout will do.
        let same = saved.x.len() == layout.variables() && saved.has_multipliers(layout.rows());
        return same.then(|| layout.clone());
    }
    let points = layout.points;
    let rows = saved.multipliers.len();
    let fixed = Layout {
        free_duration: false,
        ..layout.clone()
    };
    let extra = saved.x.len().checked_sub(fixed.variables())?;
    // The same boundary rows where that is possible, otherwise as few as can be.
    let boundary = match rows.checked_sub(layout.boundary) {
        Some(rest) if rest % points == 0 => layout.boundary,
        _ => rows % points,
    };
    let path = ((rows - boundary) / points).checked_sub(layout.states)?;
    let old = Layout {
        path,
        boundary,
        free_duration: extra == 1,
        ..layout.clone()
    };
    (extra <= 1 && saved.has_multipliers(old.rows())).then_some(old)
}

/// The trajectory on `mesh`: states by their polynomials, controls linearly between points.
///
/// Controls jump where they meet a limit; polynomials through them ring there and would start the
/// solver outside the limits.
pub(super) fn resample(trajectory: &Discretization, mesh: Mesh) -> Discretization {
    let mut times = trajectory.mesh.node_fractions();
    times.pop();
    let mut sampled = trajectory.resample(mesh);
    let fractions = sampled.mesh.node_fractions();
    let width = trajectory.controls;
    for (k, &fraction) in fractions[..sampled.mesh.points()].iter().enumerate() {
        let bracket = Bracket::of(&times, fraction);
        let row = &mut sampled.u[k * width..(k + 1) * width];
        for (j, value) in row.iter_mut().enumerate() {
            *value = bracket.interpolate(|k| trajectory.control(k)[j]);
        }
    }
    sampled
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ocp::{Formulation, Interval, Quantity, WayPoint};

    #[test]
    fn a_costate_that_jumps_at_a_way_point_jumps_on_the_new_mesh() {
        let formulation = Formulation {
            states: vec![Quantity::new("x", Interval::symmetric(1.0))],
            controls: vec![Quantity::new("u", Interval::symmetric(1.0))],
            path: vec![],
            boundary: vec![],
            initial: vec![Interval::FREE],
            terminal: vec![Interval::FREE],
            way_points: vec![WayPoint {
                fraction: 0.4,
                states: vec![Interval::new(0.0, 0.5)],
                rows: vec![Quantity::new("row", Interval::FREE)],
            }],
            ..Formulation::between(Interval::new(0.0, 1.0), Interval::new(1.5, 2.0))
        }
        .parameter(Quantity::new("p", Interval::FREE), 0.0)
        .integral(Quantity::new("q", Interval::FREE));
        let mesh = |points: &[usize]| Mesh::new(vec![0.0, 0.4, 1.0], points).unwrap();
        let (coarse, fine) = (mesh(&[3, 4]), mesh(&[7, 5]));
        let layouts = [&coarse, &fine].map(|mesh| Layout::new(&formulation, mesh));
        let [from, to] = &layouts;
        let costate = |k: usize, mesh: &Mesh| if k < mesh.start(1) { 2.0 } else { -3.0 };
        let mut iterate = Iterate {
            x: vec![0.0; from.variables()],
            multipliers: vec![0.0; from.rows()],
            lower_multipliers: vec![0.0; from.variables()],
            upper_multipliers: vec![0.0; from.variables()],
        };
        for (k, weight) in weights(&coarse).into_iter().enumerate() {
            iterate.multipliers[from.defect(k, 0)] = weight.defect * costate(k, &coarse);
        }
        let node = coarse.start(1);
        // What belongs to no instant: T, t₀, a parameter, an integral, the rows of that and of t_f.
        for (value, variable) in (10..).zip(from.border()) {
            iterate.upper_multipliers[variable] = f64::from(value);
        }
        iterate.multipliers[from.integral_row(0)] = 8.0;
        iterate.multipliers[from.final_time_row()] = 9.0;
        iterate.multipliers[from.way_point(0, 0)] = 5.0;
        iterate.upper_multipliers[from.state(node, 0)] = 7.0;
        let read = Duals::new(&coarse, from, &iterate).on(&fine, to, vec![0.0; to.variables()]);
        for (k, weight) in weights(&fine).into_iter().enumerate() {
            let found = read.multipliers[to.defect(k, 0)] / weight.defect;
            assert!((found - costate(k, &fine)).abs() < 1e-14, "{k}: {found}");
        }
        assert_eq!(read.multipliers[to.way_point(0, 0)], 5.0);
        assert_eq!(
            read.upper_multipliers[to.border()],
            [10.0, 11.0, 12.0, 13.0]
        );
        assert_eq!(read.multipliers[to.integral_row(0)..], [8.0, 9.0]);
        for k in 0..=fine.points() {
            let expected = if k == fine.start(1) { 7.0 } else { 0.0 };
            assert_eq!(read.upper_multipliers[to.state(k, 0)], expected, "{k}");
        }
    }
}
