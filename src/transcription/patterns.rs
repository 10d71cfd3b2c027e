//! Sparsity of a problem's functions, found once and used on every mesh.

use super::functions::{Boundary, Node, WayPoint};
use crate::autodiff::{Function, Sparsity};
use crate::ocp::{Formulation, Interval, Ocp};

/// Which derivatives of (f, C, ℒ), of (E, Φ) and of each way-point's rows are ever nonzero.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Patterns {
    pub(super) node: Sparsity,
    pub(super) ends: Sparsity,
    pub(super) way_points: Vec<Sparsity>,
}

impl Patterns {
    /// Samples derivatives at random points of the bounds' box; the same points every time.
    pub fn detect<O: Ocp>(ocp: &O) -> Self {
        let formulation = ocp.formulation();
        let node = Node::new(ocp, &formulation);
        let ends = Boundary::new(ocp, &formulation);
        let free_duration = !formulation.duration.is_fixed();
        let mut node_used = vec![true; node.inputs()];
        node_used[node.time()] = free_duration;
        let mut end_used = vec![true; ends.inputs()];
        end_used[ends.duration()] = free_duration;
        let points = (0..formulation.way_points.len())
            .map(|index| WayPoint::new(ocp, &formulation, index))
            .collect::<Vec<_>>();
        let mut point_used = vec![true; formulation.states.len() + 1];
        point_used[formulation.states.len()] = free_duration;
        if ocp.has_branches() {
            return Self {
                node: Sparsity::dense(node.outputs(), &node_used),
                ends: Sparsity::dense(ends.outputs(), &end_used),
                way_points: points
                    .iter()
                    .map(|point| Sparsity::dense(point.rows, &point_used))
                    .collect(),
            };
        }
        let mut draw = Draw::new(&formulation);
        Self {
            node: Sparsity::sampled(&node, &node_used, |v| {
                let duration = draw.within(&formulation.duration);
                let quantities = formulation.states.iter().chain(&formulation.controls);
                for (value, quantity) in v.iter_mut().zip(quantities) {
                    *value = draw.within(&quantity.bounds);
                }
                v[node.time()] = draw.within(&Interval::new(0.0, duration));
            }),
            ends: Sparsity::sampled(&ends, &end_used, |v| {
                let states = formulation.states.iter().chain(&formulation.states);
                for (value, quantity) in v.iter_mut().zip(states) {
                    *value = draw.within(&quantity.bounds);
                }
                v[ends.duration()] = draw.within(&formulation.duration);
            }),
            way_points: points
                .iter()
                .map(|point| {
                    Sparsity::sampled(point, &point_used, |v| {
                        for (value, quantity) in v.iter_mut().zip(&formulation.states) {
                            *value = draw.within(&quantity.bounds);
                        }
                        v[point.states] = draw.within(&formulation.duration);
                    })
                })
                .collect(),
        }
    }
}

impl Patterns {
    /// Whether path row `p` is a function of the states and the time alone. What depends on the
    /// controls as well jumps where they switch.
    pub fn path_is_continuous(&self, formulation: &Formulation, p: usize) -> bool {
        let (states, controls) = formulation.widths();
        let inputs = &self.node.jacobian[states + p];
        !inputs
            .iter()
            .any(|input| (states..states + controls).contains(input))
    }
}

/// Draws values within bounds.
struct Draw(fastrand::Rng);

impl Draw {
    /// Seeded by the problem's size alone, so that runs repeat.
    fn new(formulation: &Formulation) -> Self {
        Self(fastrand::Rng::with_seed(formulation.states.len() as u64))
    }

    fn within(&mut self, bounds: &Interval) -> f64 {
        let unit = self.0.f64();
        match (bounds.lower.is_finite(), bounds.upper.is_finite()) {
            (true, true) => bounds.lower + unit * (bounds.upper - bounds.lower),
            (true, false) => bounds.lower + unit,
            (false, true) => bounds.upper - unit,
            (false, false) => 2.0 * unit - 1.0,
        }
    }
}
