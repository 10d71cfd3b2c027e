//! Evaluates the rows of the way-points, each at its own node.

use super::points::Shared;
use super::{Layout, Patterns};
use crate::autodiff::Sparsity;
use crate::ocp::{Derivatives, DynOcp, Formulation, Part, Shape, WayPointShape};

/// One way-point with its values and derivatives at the current iterate.
pub(super) struct WayPointEvaluation<'a> {
    shape: WayPointShape,
    derivatives: Box<dyn Derivatives + 'a>,
    /// Variable behind each input: the states at its node, static parameters, t₀, the duration.
    pub columns: Vec<usize>,
    pub values: Vec<f64>,
    /// Jacobian nonzeros, row by row.
    pub first: Vec<f64>,
    inputs: Vec<f64>,
}

/// The way-points of a problem.
pub(super) fn way_points<'a>(
    ocp: &'a dyn DynOcp,
    formulation: &Formulation,
    patterns: &Patterns,
    layout: &Layout,
) -> Vec<WayPointEvaluation<'a>> {
    layout
        .way_point_nodes()
        .enumerate()
        .map(|(index, node)| {
            let shape = WayPointShape::of(formulation, index);
            let pattern = &patterns.way_points[index];
            let states = (0..layout.states).map(|i| layout.state(node, i));
            WayPointEvaluation {
                columns: states
                    .chain((0..layout.parameters).map(|i| layout.parameter(i)))
                    .chain([layout.initial_time(), layout.duration()])
                    .collect(),
                values: vec![0.0; shape.outputs()],
                first: vec![0.0; pattern.nonzeros()],
                inputs: vec![0.0; shape.inputs()],
                derivatives: ocp.differentiate(Part::WayPoint(index), formulation, pattern.clone()),
                shape,
            }
        })
        .collect()
}

impl WayPointEvaluation<'_> {
    pub fn sparsity(&self) -> &Sparsity {
        self.derivatives.sparsity()
    }

    fn load(&mut self, x: &[f64], shared: Shared<'_>) {
        let states = self.shape.states;
        let node = self.columns[0];
        let times = states + shared.parameters.len();
        self.inputs[..states].copy_from_slice(&x[node..node + states]);
        self.inputs[states..times].copy_from_slice(shared.parameters);
        self.inputs[times] = shared.initial_time;
        self.inputs[times + 1] = shared.duration;
    }

    pub fn evaluate(&mut self, x: &[f64], shared: Shared<'_>) {
        self.load(x, shared);
        self.derivatives.values(&self.inputs, &mut self.values);
    }

    pub fn differentiate(&mut self, x: &[f64], shared: Shared<'_>) {
        self.load(x, shared);
        self.derivatives.jacobian(&self.inputs, &mut self.first);
    }

    /// Weighted Hessian into `out`.
    pub fn hessian(&mut self, x: &[f64], shared: Shared<'_>, weights: &[f64], out: &mut [f64]) {
        self.load(x, shared);
        self.derivatives.hessian(&self.inputs, weights, out);
    }
}
