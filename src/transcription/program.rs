//! The transcription as a sparse programme.

use super::evaluation::Evaluation;
use super::hessian::{Hessian, Multipliers};
use super::jacobian::{Jacobian, Parts};
use super::names::Names;
use super::objective;
use super::quadrature::integrals;
use super::structure::LinearRow;
use super::triplets::Triplets;
use super::{Discretization, Layout, Patterns, Structure};
use crate::collocation::Mesh;
use crate::nlp::{Iterate, Nlp, Size, Undefined};
use crate::ocp::{DynOcp, Formulation, Interval};
use std::fmt;

/// Part of the steepest slope by a control on a bound that may point inward elsewhere in its arc.
const WRONG: f64 = 0.05;

/// An optimal control problem on one mesh: minimise (25) subject to (26) and (27).
pub struct Transcription<'a> {
    formulation: Formulation,
    mesh: Mesh,
    structure: Structure,
    structural: Vec<LinearRow>,
    layout: Layout,
    names: Names,
    ocp: &'a dyn DynOcp,
    evaluation: Evaluation<'a>,
    jacobian: Jacobian,
    hessian: Hessian,
}

impl fmt::Debug for Transcription<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Transcription")
            .field("mesh", &self.mesh)
            .field("layout", &self.layout)
            .finish_non_exhaustive()
    }
}

impl<'a> Transcription<'a> {
    /// Lays the problem out on `mesh`, with its sparsity as found by [`Patterns::detect`].
    pub fn new(ocp: &'a dyn DynOcp, patterns: &Patterns, mesh: Mesh) -> Self {
        Self::within(ocp, ocp.formulation(), patterns, mesh)
    }

    /// The same within the bounds of `formulation`, which is that of the problem but for them.
    pub fn within(
        ocp: &'a dyn DynOcp,
        formulation: Formulation,
        patterns: &Patterns,
        mesh: Mesh,
    ) -> Self {
        Self::structured(ocp, formulation, patterns, mesh, Structure::default())
    }

    /// The same with what `structure` knows of the solution.
    ///
    /// # Panics
    /// Where breakpoints are free and the problem depends on time.
    pub fn structured(
        ocp: &'a dyn DynOcp,
        formulation: Formulation,
        patterns: &Patterns,
        mesh: Mesh,
        structure: Structure,
    ) -> Self {
        let layout = Layout::structured(&formulation, &mesh, &structure);
        let structural =
            structure.linear_rows(&mesh, |k, i| layout.state(k, i), |i| layout.knot(i));
        let evaluation = Evaluation::new(
            ocp,
            &formulation,
            patterns,
            &mesh,
            &structure,
            layout.clone(),
        );
        let columns = evaluation.node_derivatives().sparsity().columns();
        assert!(
            structure.knots.is_empty() || !columns.contains(&evaluation.node.time()),
            "free breakpoints need a problem that does not depend on time"
        );
        Self {
            ocp,
            names: Names::new(formulation.clone(), &mesh),
            jacobian: Jacobian::new(&Parts {
                layout: &layout,
                mesh: &mesh,
                structural: &structural,
                evaluation: &evaluation,
            }),
            hessian: Hessian::new(&layout, &evaluation),
            formulation,
            structure,
            structural,
            mesh,
            layout,
            evaluation,
        }
    }

    fn jacobian_places(&self) -> Triplets {
        Jacobian::places(&Parts {
            layout: &self.layout,
            mesh: &self.mesh,
            structural: &self.structural,
            evaluation: &self.evaluation,
        })
    }

    /// Where variables and rows stand.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// What the mesh knows of the solution's arcs.
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// Quantities and bounds of the problem.
    pub fn formulation(&self) -> &Formulation {
        &self.formulation
    }

    /// The programme's variables for a trajectory on this mesh. Integrals have the values that
    /// follow from it.
    ///
    /// # Panics
    /// Where the trajectory has not as many static parameters as the problem.
    pub fn pack(&self, trajectory: &Discretization) -> Vec<f64> {
        let integrals = integrals(self.ocp, &self.formulation, trajectory);
        let layout = &self.layout;
        let mut x = vec![0.0; layout.variables()];
        for k in 0..=layout.points {
            let start = layout.state(k, 0);
            x[start..start + layout.states].copy_from_slice(trajectory.state(k));
            if k < layout.points {
                let start = layout.control(k, 0);
                x[start..start + layout.controls].copy_from_slice(trajectory.control(k));
            }
        }
        for (i, knot) in self.structure.knots.iter().enumerate() {
            x[layout.knot(i)] = trajectory.mesh.breakpoints()[knot.breakpoint];
        }
        if layout.free_duration {
            x[layout.duration()] = trajectory.duration;
        }
        if layout.free_initial_time {
            x[layout.initial_time()] = trajectory.initial_time;
        }
        x[layout.parameter(0)..layout.integral(0)].copy_from_slice(&trajectory.parameters);
        x[layout.integral(0)..].copy_from_slice(&integrals);
        x
    }

    /// The trajectory of the programme's variables `x`.
    pub fn unpack(&self, x: &[f64]) -> Discretization {
        let layout = &self.layout;
        let mut states = Vec::with_capacity((layout.points + 1) * layout.states);
        for k in 0..=layout.points {
            states.extend_from_slice(&x[layout.state(k, 0)..][..layout.states]);
        }
        let mut controls = Vec::with_capacity(layout.points * layout.controls);
        for k in 0..layout.points {
            controls.extend_from_slice(&x[layout.control(k, 0)..][..layout.controls]);
        }
        Discretization {
            mesh: self.evaluation.grid.mesh(x),
            initial_time: self.evaluation.initial_time(x),
            duration: self.evaluation.duration(x),
            parameters: x[layout.parameter(0)..layout.integral(0)].to_vec(),
            integrals: x[layout.integral(0)..].to_vec(),
            states: layout.states,
            controls: layout.controls,
            x: states,
            u: controls,
        }
    }
}

impl Nlp for Transcription<'_> {
    fn size(&self) -> Size {
        Size {
            variables: self.layout.variables(),
            constraints: self.layout.rows(),
            jacobian_nonzeros: self.jacobian.nonzeros,
            hessian_nonzeros: self.hessian.places.len(),
        }
    }

    fn variable_bounds(&self, lower: &mut [f64], upper: &mut [f64]) {
        let layout = &self.layout;
        for k in 0..=layout.points {
            for (i, state) in self.formulation.states.iter().enumerate() {
                let mut bounds = state.bounds;
                if k == 0 {
                    bounds = bounds.intersect(&self.formulation.initial[i]);
                }
                if k == layout.points {
                    bounds = bounds.intersect(&self.formulation.terminal[i]);
                }
                (lower[layout.state(k, i)], upper[layout.state(k, i)]) =
                    (bounds.lower, bounds.upper);
            }
        }
        for (point, node) in self
            .formulation
            .way_points
            .iter()
            .zip(layout.way_point_nodes())
        {
            for (i, bounds) in point.states.iter().enumerate() {
                let v = layout.state(node, i);
                let bounds = bounds.intersect(&Interval::new(lower[v], upper[v]));
                (lower[v], upper[v]) = (bounds.lower, bounds.upper);
            }
        }
        for k in 0..layout.points {
            for (j, control) in self.formulation.controls.iter().enumerate() {
                lower[layout.control(k, j)] = control.bounds.lower;
                upper[layout.control(k, j)] = control.bounds.upper;
            }
        }
        for fixed in &self.structure.fixed {
            let s = fixed.segment;
            for k in self.mesh.start(s)..self.mesh.start(s + 1) {
                lower[layout.control(k, fixed.control)] = fixed.value;
                upper[layout.control(k, fixed.control)] = fixed.value;
            }
        }
        for (i, knot) in self.structure.knots.iter().enumerate() {
            lower[layout.knot(i)] = knot.window.lower;
            upper[layout.knot(i)] = knot.window.upper;
        }
        if layout.free_duration {
            lower[layout.duration()] = self.formulation.duration.lower;
            upper[layout.duration()] = self.formulation.duration.upper;
        }
        if layout.free_initial_time {
            lower[layout.initial_time()] = self.formulation.initial_time.lower;
            upper[layout.initial_time()] = self.formulation.initial_time.upper;
        }
        let constants = [&self.formulation.parameters, &self.formulation.integrals];
        for (v, quantity) in (layout.parameter(0)..).zip(constants.into_iter().flatten()) {
            lower[v] = quantity.bounds.lower;
            upper[v] = quantity.bounds.upper;
        }
    }

    fn constraint_bounds(&self, lower: &mut [f64], upper: &mut [f64]) {
        let layout = &self.layout;
        lower.fill(0.0);
        upper.fill(0.0);
        for k in 0..layout.points {
            for (p, row) in self.formulation.path.iter().enumerate() {
                lower[layout.path(k, p)] = row.bounds.lower;
                upper[layout.path(k, p)] = row.bounds.upper;
            }
        }
        for fixed in &self.structure.rows {
            let s = fixed.segment;
            for k in self.mesh.start(s)..self.mesh.start(s + 1) {
                lower[layout.path(k, fixed.row)] = fixed.value;
                upper[layout.path(k, fixed.row)] = fixed.value;
            }
        }
        for (w, point) in self.formulation.way_points.iter().enumerate() {
            for (r, row) in point.rows.iter().enumerate() {
                lower[layout.way_point(w, r)] = row.bounds.lower;
                upper[layout.way_point(w, r)] = row.bounds.upper;
            }
        }
        for (b, row) in self.formulation.boundary.iter().enumerate() {
            lower[layout.boundary(b)] = row.bounds.lower;
            upper[layout.boundary(b)] = row.bounds.upper;
        }
        if layout.bounded_final_time {
            lower[layout.final_time_row()] = self.formulation.final_time.lower;
            upper[layout.final_time_row()] = self.formulation.final_time.upper;
        }
        for (i, row) in self.structural.iter().enumerate() {
            lower[layout.structural_row(i)] = row.bounds.lower;
            upper[layout.structural_row(i)] = row.bounds.upper;
        }
    }

    fn jacobian_structure(&self, rows: &mut [usize], columns: &mut [usize]) {
        self.jacobian_places().write(rows, columns);
    }

    fn hessian_structure(&self, rows: &mut [usize], columns: &mut [usize]) {
        self.hessian.places.write(rows, columns);
    }

    fn new_point(&mut self) {
        self.evaluation.forget();
    }

    fn objective(&mut self, x: &[f64]) -> Result<f64, Undefined> {
        self.evaluation.need_values(x);
        let duration = self.evaluation.duration(x);
        let value = objective::objective(duration, &self.evaluation);
        if value.is_finite() {
            Ok(value)
        } else {
            Err(Undefined {
                function: "objective",
            })
        }
    }

    fn gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<(), Undefined> {
        self.need_all(x)?;
        let duration = self.evaluation.duration(x);
        objective::gradient(duration, &self.layout, &self.evaluation, gradient);
        Ok(())
    }

    fn constraints(&mut self, x: &[f64], values: &mut [f64]) -> Result<(), Undefined> {
        self.evaluation.need_values(x);
        let duration = self.evaluation.duration(x);
        let layout = &self.layout;
        for s in 0..self.mesh.segments() {
            let rule = self.mesh.rule(s);
            let start = self.mesh.start(s);
            let half = duration * self.evaluation.grid.half_width[start];
            for i in 0..rule.len() {
                let outputs = self.evaluation.outputs(start + i);
                let rows = layout.defect(start + i, 0);
                for r in 0..layout.states {
                    let derivative: f64 = rule
                        .differentiation(i)
                        .iter()
                        .enumerate()
                        .map(|(j, d)| d * x[layout.state(start + j, r)])
                        .sum();
                    values[rows + r] = derivative - half * outputs[r];
                }
                values[rows + layout.states..rows + layout.states + layout.path]
                    .copy_from_slice(&outputs[layout.states..layout.states + layout.path]);
            }
        }
        for (w, point) in self.evaluation.way_points.iter().enumerate() {
            let first = layout.way_point(w, 0);
            values[first..first + point.values.len()].copy_from_slice(&point.values);
        }
        values[layout.boundary(0)..layout.integral_row(0)]
            .copy_from_slice(&self.evaluation.end_values[..layout.boundary]);
        for i in 0..layout.integrals {
            let output = self.evaluation.node.cost() + 1 + i;
            let mut sum = 0.0;
            for (k, w) in self.evaluation.grid.quadrature.iter().enumerate() {
                sum += w * self.evaluation.outputs(k)[output];
            }
            values[layout.integral_row(i)] = x[layout.integral(i)] - duration * sum;
        }
        if layout.bounded_final_time {
            values[layout.final_time_row()] = self.evaluation.initial_time(x) + duration;
        }
        for (i, row) in self.structural.iter().enumerate() {
            let terms = row.terms.iter().map(|&(v, weight)| weight * x[v]);
            values[layout.structural_row(i)] = terms.sum();
        }
        if values.iter().all(|v| v.is_finite()) {
            Ok(())
        } else {
            Err(Undefined {
                function: "constraints",
            })
        }
    }

    fn jacobian(&mut self, x: &[f64], values: &mut [f64]) -> Result<(), Undefined> {
        self.need_all(x)?;
        let duration = self.evaluation.duration(x);
        self.jacobian
            .values(duration, &self.mesh, &self.evaluation, values);
        Ok(())
    }

    fn hessian(
        &mut self,
        x: &[f64],
        sigma: f64,
        multipliers: &[f64],
        values: &mut [f64],
    ) -> Result<(), Undefined> {
        self.evaluation.grid.place(x);
        if self.layout.free_duration || self.evaluation.grid.is_free() {
            self.need_all(x)?;
        }
        self.hessian.values(
            x,
            Multipliers {
                objective: sigma,
                rows: multipliers,
            },
            &mut self.evaluation,
            values,
        )
    }

    fn variable_name(&self, index: usize) -> String {
        self.names.variable(&self.layout, index)
    }

    fn constraint_name(&self, index: usize) -> String {
        self.names.row(&self.layout, index)
    }
}

impl Transcription<'_> {
    /// Values and first derivatives; values only where a derivative by the duration needs them.
    fn need_all(&mut self, x: &[f64]) -> Result<(), Undefined> {
        if self.layout.free_duration || self.evaluation.grid.is_free() {
            self.evaluation.need_values(x);
        }
        self.evaluation.need_first(x)
    }

    /// Whether every control and row that the structure fixes on one of its bounds is better there than
    /// inside, by the slope of the Lagrangian at `iterate` and by the rows' multipliers: within a part of
    /// the steepest in the arc.
    pub fn arcs_hold(&mut self, iterate: &Iterate) -> bool {
        if self.structure.fixed.is_empty() && self.structure.rows.is_empty() {
            return true;
        }
        let Some(slope) = self.slope(iterate) else {
            return false;
        };
        let weights = &self.evaluation.grid.quadrature;
        // The loss by a step inward must be one everywhere.
        let holds = |segment: usize, loss: &dyn Fn(usize) -> f64| {
            let points = self.mesh.start(segment)..self.mesh.start(segment + 1);
            let (mut least, mut most) = (0.0_f64, 0.0_f64);
            for loss in points.map(|k| loss(k) / weights[k]) {
                least = least.min(loss);
                most = most.max(loss);
            }
            -least <= WRONG * most
        };
        let inward = |value: f64, bounds: &Interval| match value == bounds.lower {
            true => 1.0,
            false => -1.0,
        };
        let controls = self.structure.fixed.iter().all(|fixed| {
            let bounds = &self.formulation.controls[fixed.control].bounds;
            let side = inward(fixed.value, bounds);
            holds(fixed.segment, &|k| {
                side * slope[self.layout.control(k, fixed.control)]
            })
        });
        let rows = self.structure.rows.iter().all(|fixed| {
            let bounds = &self.formulation.path[fixed.row].bounds;
            let side = inward(fixed.value, bounds);
            holds(fixed.segment, &|k| {
                -side * iterate.multipliers[self.layout.path(k, fixed.row)]
            })
        });
        controls && rows
    }

    /// The gradient of the Lagrangian, bounds left out.
    fn slope(&mut self, iterate: &Iterate) -> Option<Vec<f64>> {
        let mut slope = vec![0.0; self.layout.variables()];
        let mut values = vec![0.0; self.jacobian.nonzeros];
        self.new_point();
        self.gradient(&iterate.x, &mut slope).ok()?;
        Nlp::jacobian(self, &iterate.x, &mut values).ok()?;
        for ((row, column), value) in self.jacobian_places().iter().zip(values) {
            slope[column] += iterate.multipliers[row] * value;
        }
        Some(slope)
    }
}
