//! Evaluates the rows of the way-points, each at its own node.

use super::functions::WayPoint;
use super::points::Shared;
use super::{Layout, Patterns};
use crate::autodiff::{Function, SparseDerivatives, Sparsity};
use crate::ocp::{Formulation, Ocp};

/// One way-point with its values and derivatives at the current iterate.
pub(super) struct WayPointEvaluation<'a, O: Ocp> {
    function: WayPoint<'a, O>,
    derivatives: SparseDerivatives<WayPoint<'a, O>>,
    /// Variable behind each input: the states at its node, static parameters, t₀, the duration.
    pub columns: Vec<usize>,
    pub values: Vec<f64>,
    /// Jacobian nonzeros, row by row.
    pub first: Vec<f64>,
    inputs: Vec<f64>,
}

/// The way-points of a problem.
pub(super) fn way_points<'a, O: Ocp>(
    ocp: &'a O,
    formulation: &Formulation,
    patterns: &Patterns,
    layout: &Layout,
) -> Vec<WayPointEvaluation<'a, O>> {
    layout
        .way_point_nodes()
        .enumerate()
        .map(|(index, node)| {
            let function = WayPoint::new(ocp, formulation, index);
            let derivatives = SparseDerivatives::new(&function, patterns.way_points[index].clone());
            let states = (0..layout.states).map(|i| layout.state(node, i));
            WayPointEvaluation {
                columns: states
                    .chain((0..layout.parameters).map(|i| layout.parameter(i)))
                    .chain([layout.initial_time(), layout.duration()])
                    .collect(),
                values: vec![0.0; function.rows],
                first: vec![0.0; derivatives.jacobian_nonzeros()],
                inputs: vec![0.0; function.inputs()],
                derivatives,
                function,
            }
        })
        .collect()
}

impl<O: Ocp> WayPointEvaluation<'_, O> {
    pub fn sparsity(&self) -> &Sparsity {
        self.derivatives.sparsity()
    }

    fn load(&mut self, x: &[f64], shared: Shared<'_>) {
        let states = self.function.states;
        let node = self.columns[0];
        let times = states + shared.parameters.len();
        self.inputs[..states].copy_from_slice(&x[node..node + states]);
        self.inputs[states..times].copy_from_slice(shared.parameters);
        self.inputs[times] = shared.initial_time;
        self.inputs[times + 1] = shared.duration;
    }

    pub fn evaluate(&mut self, x: &[f64], shared: Shared<'_>) {
        self.load(x, shared);
        self.derivatives
            .values(&self.function, &self.inputs, &mut self.values);
    }

    pub fn differentiate(&mut self, x: &[f64], shared: Shared<'_>) {
        self.load(x, shared);
        self.derivatives
            .jacobian(&self.function, &self.inputs, &mut self.first);
    }

    /// Weighted Hessian into `out`.
    pub fn hessian(&mut self, x: &[f64], shared: Shared<'_>, weights: &[f64], out: &mut [f64]) {
        self.load(x, shared);
        self.derivatives
            .hessian(&self.function, &self.inputs, weights, out);
    }
}
