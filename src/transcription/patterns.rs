//! Sparsity of a problem's functions, found once and used on every mesh.

use super::functions::{Boundary, Node, WayPoint};
use crate::autodiff::{Function, Sparsity};
use crate::ocp::{Formulation, Interval, Ocp, Quantity};

/// Which derivatives of (f, C, ℒ), of (E, Φ) and of each way-point's rows may be nonzero.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Patterns {
    pub(super) node: Sparsity,
    pub(super) ends: Sparsity,
    pub(super) way_points: Vec<Sparsity>,
}

impl Patterns {
    /// Follows the operations of each function from its variables to its values.
    ///
    /// Bounds play no part, so that the patterns hold however they are changed.
    pub fn detect<O: Ocp>(ocp: &O) -> Self {
        let formulation = ocp.formulation();
        let inside = |quantities: &[Quantity]| -> Vec<f64> {
            let bounds = quantities.iter().map(|quantity| &quantity.bounds);
            bounds.map(inner_value).collect()
        };
        let states = inside(&formulation.states);
        let controls = inside(&formulation.controls);
        let time = [inner_value(&formulation.duration)];
        let find = Find {
            branches: ocp.has_branches(),
            free_duration: !formulation.duration.is_fixed(),
        };
        let points = 0..formulation.way_points.len();
        Self {
            node: find.in_function(
                &Node::new(ocp, &formulation),
                &[&states[..], &controls, &time].concat(),
            ),
            ends: find.in_function(
                &Boundary::new(ocp, &formulation),
                &[&states[..], &states, &time].concat(),
            ),
            way_points: points
                .map(|index| {
                    find.in_function(
                        &WayPoint::new(ocp, &formulation, index),
                        &[&states[..], &time].concat(),
                    )
                })
                .collect(),
        }
    }

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

/// How the patterns of one problem are found.
struct Find {
    branches: bool,
    free_duration: bool,
}

impl Find {
    /// The pattern of `f`, whose last input is a time, evaluated at `at`.
    fn in_function<F: Function>(&self, f: &F, at: &[f64]) -> Sparsity {
        let mut used = vec![true; f.inputs()];
        used[f.inputs() - 1] = self.free_duration;
        if self.branches {
            Sparsity::dense(f.outputs(), &used)
        } else {
            Sparsity::traced(f, &used, at)
        }
    }
}

/// A value within bounds and, where they leave room, not on them.
fn inner_value(bounds: &Interval) -> f64 {
    match (bounds.lower.is_finite(), bounds.upper.is_finite()) {
        (true, true) => bounds.lower + 0.4 * (bounds.upper - bounds.lower),
        (true, false) => bounds.lower + 0.4,
        (false, true) => bounds.upper - 0.4,
        (false, false) => 0.4,
    }
}
