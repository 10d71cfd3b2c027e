//! Carries a solution, primal and dual, from one mesh to another.

use crate::collocation::Mesh;
use crate::nlp::Iterate;
use crate::transcription::{Discretization, Layout};

/// Multipliers of a programme seen as functions of time, on the mesh they were found on.
///
/// A defect's multiplier is the quadrature weight w times a costate; a path row's or a bound's is
/// w·(width/2) times a density. Divided by those, they can be read on any mesh. In between they
/// are interpolated linearly: they jump where a limit becomes active, and polynomials would ring.
/// Costates jump at way-points as well, and are interpolated between those only.
pub(super) struct Duals<'a> {
    layout: &'a Layout,
    iterate: &'a Iterate,
    times: Vec<f64>,
    weights: Vec<Weight>,
    /// First points of the legs between way-points, and the number of all points.
    legs: Vec<usize>,
}

#[derive(Debug, Clone, Copy)]
struct Weight {
    defect: f64,
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

impl<'a> Duals<'a> {
    /// The multipliers in `iterate`, which belong to `mesh` and `layout`.
    pub fn new(mesh: &'a Mesh, layout: &'a Layout, iterate: &'a Iterate) -> Self {
        let mut times = mesh.node_fractions();
        times.pop();
        let nodes = layout.way_point_nodes();
        Self {
            legs: [0].into_iter().chain(nodes).chain([times.len()]).collect(),
            layout,
            iterate,
            times,
            weights: weights(mesh),
        }
    }

    /// The two points around `fraction` and how far it is from the first to the second; both in
    /// the same leg.
    fn around(&self, fraction: f64) -> (usize, usize, f64) {
        let legs = &self.legs[1..self.legs.len() - 1];
        let leg = legs.partition_point(|&first| self.times[first] <= fraction);
        let (first, end) = (self.legs[leg], self.legs[leg + 1]);
        let (a, b, share) = around(&self.times[first..end], fraction);
        (first + a, first + b, share)
    }

    /// A starting iterate on another mesh: `x` with the multipliers read there.
    pub fn on(&self, mesh: &Mesh, layout: &Layout, x: Vec<f64>) -> Iterate {
        let old = self.layout;
        let from = self.iterate;
        let mut to = Iterate {
            multipliers: vec![0.0; layout.rows()],
            lower_multipliers: vec![0.0; layout.variables()],
            upper_multipliers: vec![0.0; layout.variables()],
            x,
        };
        let mut fractions = mesh.node_fractions();
        fractions.pop();
        let is_way_point = |k: usize| old.way_point_nodes().any(|node| node == k);
        // What a state's bound at a way-point is worth is no density: the next point's is.
        let last = self.times.len() - 1;
        let beside = |k: usize| {
            if is_way_point(k) {
                (k + 1).min(last)
            } else {
                k
            }
        };
        for (k, (&fraction, weight)) in fractions.iter().zip(weights(mesh)).enumerate() {
            let (a, b, share) = self.around(fraction);
            let mix = |va: f64, vb: f64| (1.0 - share) * va + share * vb;
            let (wa, wb) = (self.weights[a], self.weights[b]);
            for i in 0..layout.states {
                let l = &from.multipliers;
                to.multipliers[layout.defect(k, i)] = weight.defect
                    * mix(
                        l[old.defect(a, i)] / wa.defect,
                        l[old.defect(b, i)] / wb.defect,
                    );
            }
            for p in 0..Self::common(layout.path, old.path) {
                let l = &from.multipliers;
                to.multipliers[layout.path(k, p)] = weight.density
                    * mix(
                        l[old.path(a, p)] / wa.density,
                        l[old.path(b, p)] / wb.density,
                    );
            }
            for i in 0..layout.states + layout.controls {
                let (a, b) = if i < layout.states {
                    (beside(a), beside(b))
                } else {
                    (a, b)
                };
                let (wa, wb) = (self.weights[a], self.weights[b]);
                let (va, vb, v) = (old.state(a, i), old.state(b, i), layout.state(k, i));
                for (z, out) in [
                    (&from.lower_multipliers, &mut to.lower_multipliers),
                    (&from.upper_multipliers, &mut to.upper_multipliers),
                ] {
                    out[v] = weight.density * mix(z[va] / wa.density, z[vb] / wb.density);
                }
            }
        }
        self.copy_ends(layout, &mut to);
        to
    }

    /// Rows that can be taken over: all of them, or none where the problems have not as many.
    fn common(new: usize, old: usize) -> usize {
        if new == old { new } else { 0 }
    }

    /// What belongs to one instant or to the problem as a whole has no weight and is copied.
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
        let tail = layout.states + usize::from(layout.free_duration && old.free_duration);
        for i in 0..tail {
            let (v, w) = (layout.state(layout.points, i), old.state(old.points, i));
            to.lower_multipliers[v] = self.iterate.lower_multipliers[w];
            to.upper_multipliers[v] = self.iterate.upper_multipliers[w];
        }
        for b in 0..Self::common(layout.boundary, old.boundary) {
            to.multipliers[layout.boundary(b)] = self.iterate.multipliers[old.boundary(b)];
        }
    }
}

/// Layout of the programme that multipliers saved for another problem on the same mesh belong to:
/// states and controls are those of `layout`, path and boundary rows follow from the lengths.
///
/// `None` where no layout has these lengths.
pub(super) fn saved_layout(saved: &Iterate, layout: &Layout) -> Option<Layout> {
    if layout.way_point_nodes().next().is_some() {
        // Rows between those of the points leave no way to tell; only the same problem's do.
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
        let (a, b, share) = around(&times, fraction);
        let row = &mut sampled.u[k * width..(k + 1) * width];
        let ends = trajectory.control(a).iter().zip(trajectory.control(b));
        for (value, (a, b)) in row.iter_mut().zip(ends) {
            *value = (1.0 - share) * a + share * b;
        }
    }
    sampled
}

/// The two of `times` around `fraction` and how far it is from the first to the second.
fn around(times: &[f64], fraction: f64) -> (usize, usize, f64) {
    let last = times.len() - 1;
    let right = times.partition_point(|&t| t < fraction).min(last);
    let left = right.saturating_sub(1);
    let gap = times[right] - times[left];
    let share = if gap > 0.0 {
        (fraction - times[left]) / gap
    } else {
        1.0
    };
    (left, right, share.clamp(0.0, 1.0))
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
            duration: Interval::fixed(1.0),
            way_points: vec![WayPoint {
                fraction: 0.4,
                states: vec![Interval::new(0.0, 0.5)],
                rows: vec![Quantity::new("row", Interval::FREE)],
            }],
        };
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
        iterate.multipliers[from.way_point(0, 0)] = 5.0;
        iterate.upper_multipliers[from.state(node, 0)] = 7.0;
        let read = Duals::new(&coarse, from, &iterate).on(&fine, to, vec![0.0; to.variables()]);
        for (k, weight) in weights(&fine).into_iter().enumerate() {
            let found = read.multipliers[to.defect(k, 0)] / weight.defect;
            assert!((found - costate(k, &fine)).abs() < 1e-14, "{k}: {found}");
        }
        assert_eq!(read.multipliers[to.way_point(0, 0)], 5.0);
        for k in 0..=fine.points() {
            let expected = if k == fine.start(1) { 7.0 } else { 0.0 };
            assert_eq!(read.upper_multipliers[to.state(k, 0)], expected, "{k}");
        }
    }
}
