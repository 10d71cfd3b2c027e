//! Structure and values of the constraint Jacobian.

use super::Layout;
use super::evaluation::Evaluation;
use super::structure::LinearRow;
use crate::autodiff::Sparsity;
use crate::collocation::Mesh;
use crate::ocp::Ocp;
use std::collections::BTreeMap;

/// What a nonzero of the Jacobian is made of, beyond its constant part.
#[derive(Debug, Clone, Copy)]
enum Term {
    /// −(T·width/2)·(derivative `slot` of the point).
    Rate { point: usize, slot: usize },
    /// −(width/2)·f_row − (T·width/2)·α·(time derivative, where there is one).
    RateByDuration {
        point: usize,
        row: usize,
        time: Option<usize>,
    },
    /// Derivative `slot` of the point as it is.
    Path { point: usize, slot: usize },
    /// α·(time derivative of a path row).
    PathByDuration { point: usize, slot: usize },
    /// Derivative `slot` of the ends.
    End { slot: usize },
    /// Derivative `slot` of a way-point.
    WayPoint { way_point: usize, slot: usize },
    /// −(T·quadrature weight)·(derivative `slot` of the point).
    Integrand { point: usize, slot: usize },
    /// −(quadrature weight)·(g_output + T·α·(time derivative, where there is one)).
    IntegrandByDuration {
        point: usize,
        output: usize,
        time: Option<usize>,
    },
    /// −side·(T/2)·f_row: by a free breakpoint at the start (−1) or the end (+1) of the segment.
    RateByKnot { point: usize, row: usize, side: f64 },
    /// −side·(T/2)·(weight of the rule)·g_output.
    IntegrandByKnot {
        point: usize,
        output: usize,
        side: f64,
    },
}

/// The constraint Jacobian of a transcription: triplets, constant parts and terms to add.
#[derive(Debug)]
pub(super) struct Jacobian {
    pub rows: Vec<usize>,
    pub columns: Vec<usize>,
    constant: Vec<f64>,
    /// (nonzero, term), in the order of the nonzeros.
    terms: Vec<(usize, Term)>,
}

impl Jacobian {
    pub fn new<O: Ocp>(
        layout: &Layout,
        mesh: &Mesh,
        structural: &[LinearRow],
        evaluation: &Evaluation<'_, O>,
    ) -> Self {
        let mut jacobian = Self {
            rows: Vec::new(),
            columns: Vec::new(),
            constant: Vec::new(),
            terms: Vec::new(),
        };
        for s in 0..mesh.segments() {
            for i in 0..mesh.rule(s).len() {
                jacobian.way_points(layout, evaluation, mesh.start(s) + i);
                jacobian.defects(layout, mesh, evaluation, s, i);
                jacobian.path(layout, evaluation, mesh.start(s) + i);
            }
        }
        jacobian.boundary(layout, evaluation);
        for i in 0..layout.integrals {
            jacobian.integral(layout, evaluation, i);
        }
        if layout.bounded_final_time {
            let times = [
                layout.free_duration.then(|| layout.duration()),
                layout.free_initial_time.then(|| layout.initial_time()),
            ];
            for column in times.into_iter().flatten() {
                jacobian.push(layout.final_time_row(), column, 1.0, None);
            }
        }
        for (i, row) in structural.iter().enumerate() {
            for &(column, weight) in &row.terms {
                jacobian.push(layout.structural_row(i), column, weight, None);
            }
        }
        jacobian
    }

    fn push(&mut self, row: usize, column: usize, constant: f64, term: Option<Term>) {
        if let Some(term) = term {
            self.terms.push((self.rows.len(), term));
        }
        self.rows.push(row);
        self.columns.push(column);
        self.constant.push(constant);
    }

    /// Rows (26) of point `i` of segment `s`.
    fn defects<O: Ocp>(
        &mut self,
        layout: &Layout,
        mesh: &Mesh,
        evaluation: &Evaluation<'_, O>,
        s: usize,
        i: usize,
    ) {
        let sparsity = evaluation.node_derivatives().sparsity();
        let point = mesh.start(s) + i;
        let time = evaluation.node.time();
        let mut slot = 0;
        for r in 0..layout.states {
            let row = layout.defect(point, r);
            let inputs = &sparsity.jacobian[r];
            let find = |input: usize| inputs.iter().position(|&c| c == input).map(|k| slot + k);
            for (j, &d) in mesh.rule(s).differentiation(i).iter().enumerate() {
                let term = (j == i).then(|| find(r)).flatten();
                let term = term.map(|slot| Term::Rate { point, slot });
                self.push(row, layout.state(mesh.start(s) + j, r), d, term);
            }
            for &input in inputs.iter().filter(|&&input| input != r && input != time) {
                let slot = find(input).expect("an input of the row");
                let column = layout.input(point, input);
                self.push(row, column, 0.0, Some(Term::Rate { point, slot }));
            }
            if let Some(slot) = find(time).filter(|_| layout.free_initial_time) {
                let term = Term::Rate { point, slot };
                self.push(row, layout.initial_time(), 0.0, Some(term));
            }
            if layout.free_duration && sparsity.active[r] {
                let term = Term::RateByDuration {
                    point,
                    row: r,
                    time: find(time),
                };
                self.push(row, layout.duration(), 0.0, Some(term));
            }
            for (variable, side) in evaluation.grid.sides(point).filter(|_| sparsity.active[r]) {
                let term = Term::RateByKnot {
                    point,
                    row: r,
                    side,
                };
                self.push(row, variable, 0.0, Some(term));
            }
            slot += inputs.len();
        }
    }

    fn path<O: Ocp>(&mut self, layout: &Layout, evaluation: &Evaluation<'_, O>, point: usize) {
        let sparsity = evaluation.node_derivatives().sparsity();
        let mut slot = first_slot(sparsity, layout.states);
        for p in 0..layout.path {
            let row = layout.path(point, p);
            for &input in &sparsity.jacobian[layout.states + p] {
                if input == evaluation.node.time() {
                    if layout.free_initial_time {
                        let term = Term::Path { point, slot };
                        self.push(row, layout.initial_time(), 0.0, Some(term));
                    }
                    // The first point stands at t₀ whatever the duration.
                    if layout.free_duration && evaluation.fraction(point) > 0.0 {
                        let term = Term::PathByDuration { point, slot };
                        self.push(row, layout.duration(), 0.0, Some(term));
                    }
                } else {
                    self.push(
                        row,
                        layout.input(point, input),
                        0.0,
                        Some(Term::Path { point, slot }),
                    );
                }
                slot += 1;
            }
        }
    }

    /// Rows of the way-point at the node `point`, where there is one.
    fn way_points<O: Ocp>(
        &mut self,
        layout: &Layout,
        evaluation: &Evaluation<'_, O>,
        point: usize,
    ) {
        let here = layout.way_point_nodes().position(|node| node == point);
        let Some(way_point) = here else { return };
        let evaluated = &evaluation.way_points[way_point];
        let mut slot = 0;
        for (r, inputs) in evaluated.sparsity().jacobian.iter().enumerate() {
            let row = layout.way_point(way_point, r);
            for &input in inputs {
                let term = Term::WayPoint { way_point, slot };
                self.push(row, evaluated.columns[input], 0.0, Some(term));
                slot += 1;
            }
        }
    }

    fn boundary<O: Ocp>(&mut self, layout: &Layout, evaluation: &Evaluation<'_, O>) {
        let mut slot = 0;
        for b in 0..layout.boundary {
            for &input in &evaluation.end_derivatives.sparsity().jacobian[b] {
                let column = end_column(layout, input);
                self.push(layout.boundary(b), column, 0.0, Some(Term::End { slot }));
                slot += 1;
            }
        }
    }

    /// The row of integral `i`: its value less the quadrature of its integrand.
    fn integral<O: Ocp>(&mut self, layout: &Layout, evaluation: &Evaluation<'_, O>, i: usize) {
        let sparsity = evaluation.node_derivatives().sparsity();
        let time = evaluation.node.time();
        let output = evaluation.node.cost() + 1 + i;
        let first = first_slot(sparsity, output);
        let inputs = &sparsity.jacobian[output];
        let row = layout.integral_row(i);
        self.push(row, layout.integral(i), 1.0, None);
        // Columns of the border have a term from every point.
        let mut shared: BTreeMap<usize, Vec<Term>> = BTreeMap::new();
        let border = layout.border();
        for point in 0..layout.points {
            for (slot, &input) in (first..).zip(inputs) {
                let term = Term::Integrand { point, slot };
                if input == time {
                    if layout.free_initial_time {
                        shared.entry(layout.initial_time()).or_default().push(term);
                    }
                    continue;
                }
                let column = layout.input(point, input);
                if border.contains(&column) {
                    shared.entry(column).or_default().push(term);
                } else {
                    self.push(row, column, 0.0, Some(term));
                }
            }
            if layout.free_duration && sparsity.active[output] {
                let time = inputs.iter().position(|&input| input == time);
                let term = Term::IntegrandByDuration {
                    point,
                    output,
                    time: time.map(|k| first + k),
                };
                shared.entry(layout.duration()).or_default().push(term);
            }
            for (variable, side) in evaluation.grid.sides(point) {
                let term = Term::IntegrandByKnot {
                    point,
                    output,
                    side,
                };
                shared.entry(variable).or_default().push(term);
            }
        }
        for (column, terms) in shared {
            let nonzero = self.rows.len();
            self.push(row, column, 0.0, None);
            self.terms
                .extend(terms.into_iter().map(|term| (nonzero, term)));
        }
    }

    pub fn values<O: Ocp>(
        &self,
        duration: f64,
        evaluation: &Evaluation<'_, O>,
        values: &mut [f64],
    ) {
        values.copy_from_slice(&self.constant);
        let width = evaluation.node_derivatives().jacobian_nonzeros();
        let grid = &evaluation.grid;
        let first = |point: usize, slot: usize| evaluation.first[point * width + slot];
        for &(nonzero, term) in &self.terms {
            values[nonzero] += match term {
                Term::Rate { point, slot } => {
                    -duration * grid.half_width[point] * first(point, slot)
                }
                Term::RateByDuration { point, row, time } => {
                    let by_time = time.map_or(0.0, |slot| {
                        duration * evaluation.fraction(point) * first(point, slot)
                    });
                    -grid.half_width[point] * (evaluation.outputs(point)[row] + by_time)
                }
                Term::Path { point, slot } => first(point, slot),
                Term::PathByDuration { point, slot } => {
                    evaluation.fraction(point) * first(point, slot)
                }
                Term::End { slot } => evaluation.end_first[slot],
                Term::WayPoint { way_point, slot } => evaluation.way_points[way_point].first[slot],
                Term::Integrand { point, slot } => {
                    -duration * grid.quadrature[point] * first(point, slot)
                }
                Term::IntegrandByDuration {
                    point,
                    output,
                    time,
                } => {
                    let by_time = time.map_or(0.0, |slot| {
                        duration * evaluation.fraction(point) * first(point, slot)
                    });
                    -grid.quadrature[point] * (evaluation.outputs(point)[output] + by_time)
                }
                Term::RateByKnot { point, row, side } => {
                    -side * 0.5 * duration * evaluation.outputs(point)[row]
                }
                Term::IntegrandByKnot {
                    point,
                    output,
                    side,
                } => {
                    let half = 0.5 * duration * grid.weights[point];
                    -side * half * evaluation.outputs(point)[output]
                }
            };
        }
    }
}

/// The first nonzero of `output` among those of a function's Jacobian.
pub(super) fn first_slot(sparsity: &Sparsity, output: usize) -> usize {
    sparsity.jacobian[..output].iter().map(Vec::len).sum()
}

/// Variable behind an input of the boundary function (x(t₀), x(t_f), p, q, t₀, T).
pub(super) fn end_column(layout: &Layout, input: usize) -> usize {
    let n = layout.states;
    let times = 2 * n + layout.parameters + layout.integrals;
    if input < n {
        layout.state(0, input)
    } else if input < 2 * n {
        layout.state(layout.points, input - n)
    } else if input < times {
        layout.parameter(input - 2 * n)
    } else if input == times {
        layout.initial_time()
    } else {
        layout.duration()
    }
}
