//! Evaluates an optimal control problem at all collocation points, each thing once a point.

use super::grid::Grid;
use super::node_derivatives::NodeDerivatives;
use super::points::{Points, Shared};
use super::way_point::{WayPointEvaluation, way_points};
use super::{Layout, Patterns, Structure};
use crate::collocation::Mesh;
use crate::nlp::Undefined;
use crate::ocp::{Derivatives, DynOcp, Formulation, Part, PointShape, Shape};

/// Values and derivatives at the current iterate, computed when first asked for.
pub(super) struct Evaluation<'a> {
    layout: Layout,
    fixed_duration: f64,
    fixed_initial_time: f64,
    pub node: PointShape,
    points: Points<'a>,
    /// Widths of the segments.
    pub grid: Grid,
    pub end_derivatives: Box<dyn Derivatives + 'a>,
    /// Outputs of every point, by points.
    pub values: Vec<f64>,
    /// Jacobian nonzeros of every point, by points.
    pub first: Vec<f64>,
    pub end_values: Vec<f64>,
    pub end_first: Vec<f64>,
    pub way_points: Vec<WayPointEvaluation<'a>>,
    have_values: bool,
    have_first: bool,
    end_inputs: Vec<f64>,
}

impl<'a> Evaluation<'a> {
    pub fn new(
        ocp: &'a dyn DynOcp,
        formulation: &Formulation,
        patterns: &Patterns,
        mesh: &Mesh,
        structure: &Structure,
        layout: Layout,
    ) -> Self {
        let node = PointShape::of(formulation);
        let node_derivatives = NodeDerivatives::new(ocp, formulation, patterns.node.clone());
        let end_derivatives = ocp.differentiate(Part::Ends, formulation, patterns.ends.clone());
        let mut fractions = mesh.node_fractions();
        fractions.pop();
        let starts = (0..layout.points).map(|k| layout.state(k, 0)).collect();
        Self {
            grid: Grid::new(&layout, mesh, structure),
            way_points: way_points(ocp, formulation, patterns, &layout),
            fixed_duration: formulation.duration.lower,
            fixed_initial_time: formulation.initial_time.lower,
            values: vec![0.0; layout.points * node.outputs()],
            first: vec![0.0; layout.points * node_derivatives.jacobian_nonzeros()],
            points: Points::new(
                ocp,
                formulation,
                node_derivatives,
                patterns,
                fractions,
                starts,
            ),
            end_values: vec![0.0; Part::Ends.outputs(formulation)],
            end_first: vec![0.0; patterns.ends.nonzeros()],
            have_values: false,
            have_first: false,
            end_inputs: vec![0.0; Part::Ends.inputs(formulation)],
            node,
            end_derivatives,
            layout,
        }
    }

    pub fn forget(&mut self) {
        self.have_values = false;
        self.have_first = false;
    }

    pub fn duration(&self, x: &[f64]) -> f64 {
        if self.layout.free_duration {
            x[self.layout.duration()]
        } else {
            self.fixed_duration
        }
    }

    pub fn initial_time(&self, x: &[f64]) -> f64 {
        if self.layout.free_initial_time {
            x[self.layout.initial_time()]
        } else {
            self.fixed_initial_time
        }
    }

    /// What all points share at `x`.
    fn shared<'x>(&self, x: &'x [f64]) -> Shared<'x> {
        Shared {
            initial_time: self.initial_time(x),
            duration: self.duration(x),
            parameters: &x[self.layout.parameter(0)..self.layout.integral(0)],
        }
    }

    /// Fraction of the duration of point `k`: the derivative of its time by the duration.
    pub fn fraction(&self, k: usize) -> f64 {
        self.points.fractions()[k]
    }

    /// Derivatives of a collocation point: their structure.
    pub fn node_derivatives(&self) -> &NodeDerivatives<'a> {
        self.points.derivatives()
    }

    /// Position of Φ among the outputs of the ends.
    pub fn terminal_cost(&self) -> usize {
        self.end_values.len() - 1
    }

    /// Outputs (f, C, ℒ, g) of point `k`.
    pub fn outputs(&self, k: usize) -> &[f64] {
        let width = self.node.outputs();
        &self.values[k * width..(k + 1) * width]
    }

    /// Jacobian nonzeros of point `k`, output by output.
    pub fn nonzeros(&self, k: usize) -> &[f64] {
        let width = self.node_derivatives().jacobian_nonzeros();
        &self.first[k * width..(k + 1) * width]
    }

    fn load_ends(&mut self, x: &[f64]) {
        let n = self.layout.states;
        let last = self.layout.state(self.layout.points, 0);
        self.end_inputs[..n].copy_from_slice(&x[..n]);
        self.end_inputs[n..2 * n].copy_from_slice(&x[last..last + n]);
        let constants = &x[self.layout.parameter(0)..];
        let times = 2 * n + constants.len();
        self.end_inputs[2 * n..times].copy_from_slice(constants);
        self.end_inputs[times] = self.initial_time(x);
        self.end_inputs[times + 1] = self.duration(x);
    }

    /// Makes sure that values are those at `x`.
    pub fn need_values(&mut self, x: &[f64]) {
        if self.have_values {
            return;
        }
        self.grid.place(x);
        let shared = self.shared(x);
        self.points.values(x, shared, &mut self.values);
        self.load_ends(x);
        self.end_derivatives
            .values(&self.end_inputs, &mut self.end_values);
        for point in &mut self.way_points {
            point.evaluate(x, shared);
        }
        self.have_values = true;
    }

    /// Makes sure that first derivatives are those at `x`.
    pub fn need_first(&mut self, x: &[f64]) -> Result<(), Undefined> {
        if self.have_first {
            return Ok(());
        }
        self.grid.place(x);
        let shared = self.shared(x);
        self.points.jacobians(x, shared, &mut self.first);
        self.load_ends(x);
        self.end_derivatives
            .jacobian(&self.end_inputs, &mut self.end_first);
        for point in &mut self.way_points {
            point.differentiate(x, shared);
        }
        if !self
            .first
            .iter()
            .chain(&self.end_first)
            .chain(self.way_points.iter().flat_map(|point| &point.first))
            .all(|d| d.is_finite())
        {
            return Err(Undefined {
                function: "first derivatives",
            });
        }
        self.have_first = true;
        Ok(())
    }

    /// Weighted Hessians of all points into `out`, `weights` being of all points as well.
    pub fn node_hessians(&mut self, x: &[f64], weights: &[f64], out: &mut [f64]) {
        let shared = self.shared(x);
        self.points.hessians(x, shared, weights, out);
    }

    /// Weighted Hessian of way-point `w` into `out`.
    pub fn way_point_hessian(&mut self, w: usize, x: &[f64], weights: &[f64], out: &mut [f64]) {
        let shared = self.shared(x);
        self.way_points[w].hessian(x, shared, weights, out);
    }

    /// Weighted Hessian of the ends into `out`.
    pub fn end_hessian(&mut self, x: &[f64], weights: &[f64], out: &mut [f64]) {
        self.load_ends(x);
        self.end_derivatives.hessian(&self.end_inputs, weights, out);
    }
}
