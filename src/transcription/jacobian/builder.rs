//! Puts the Jacobian together, row by row.

use super::slots::{end_column, first_slot};
use super::term::Term;
use crate::collocation::Mesh;
use crate::transcription::Layout;
use crate::transcription::evaluation::Evaluation;
use crate::transcription::structure::LinearRow;
use crate::transcription::triplets::{Triplets, index};
use std::collections::BTreeMap;

/// Nonzeros, as they are put together.
#[derive(Debug, Default)]
pub(super) struct Builder {
    pub places: Triplets,
    /// The first nonzero of every row (26), by points. With those after it, it has the coefficients of the
    /// differentiation matrix.
    pub defects: Vec<u32>,
    /// Other constant parts: nonzero and value.
    pub constants: Vec<(u32, f64)>,
    /// (nonzero, term), in the order of the nonzeros.
    pub terms: Vec<(u32, Term)>,
}

/// What a Jacobian is made from.
pub(in crate::transcription) struct Parts<'p, 'a> {
    pub layout: &'p Layout,
    pub mesh: &'p Mesh,
    pub structural: &'p [LinearRow],
    pub evaluation: &'p Evaluation<'a>,
}

impl Builder {
    pub fn build(parts: &Parts<'_, '_>) -> Self {
        let Parts {
            layout,
            mesh,
            structural,
            evaluation,
        } = *parts;
        let mut builder = Self {
            defects: Vec::with_capacity(layout.points * layout.states),
            ..Self::default()
        };
        for s in 0..mesh.segments() {
            for i in 0..mesh.rule(s).len() {
                builder.way_points(layout, evaluation, mesh.start(s) + i);
                builder.defects(layout, mesh, evaluation, s, i);
                builder.path(layout, evaluation, mesh.start(s) + i);
            }
        }
        builder.boundary(layout, evaluation);
        for i in 0..layout.integrals {
            builder.integral(layout, evaluation, i);
        }
        if layout.bounded_final_time {
            let times = [
                layout.free_duration.then(|| layout.duration()),
                layout.free_initial_time.then(|| layout.initial_time()),
            ];
            for column in times.into_iter().flatten() {
                builder.push_constant(layout.final_time_row(), column, 1.0);
            }
        }
        for (i, row) in structural.iter().enumerate() {
            for &(column, weight) in &row.terms {
                builder.push_constant(layout.structural_row(i), column, weight);
            }
        }
        builder.terms.shrink_to_fit();
        builder
    }

    fn push(&mut self, row: usize, column: usize, term: Option<Term>) -> u32 {
        let nonzero = index(self.places.push(row, column));
        if let Some(term) = term {
            self.terms.push((nonzero, term));
        }
        nonzero
    }

    fn push_constant(&mut self, row: usize, column: usize, value: f64) {
        let nonzero = self.push(row, column, None);
        self.constants.push((nonzero, value));
    }

    /// Rows (26) of point `i` of segment `s`.
    fn defects(
        &mut self,
        layout: &Layout,
        mesh: &Mesh,
        evaluation: &Evaluation<'_>,
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
            self.defects.push(index(self.places.len()));
            for j in 0..mesh.rule(s).differentiation(i).len() {
                let term = (j == i).then(|| find(r)).flatten();
                let term = term.map(|slot| Term::Rate {
                    point: index(point),
                    slot: index(slot),
                });
                self.push(row, layout.state(mesh.start(s) + j, r), term);
            }
            for &input in inputs.iter().filter(|&&input| input != r && input != time) {
                let slot = find(input).expect("an input of the row");
                let column = layout.input(point, input);
                self.push(
                    row,
                    column,
                    Some(Term::Rate {
                        point: index(point),
                        slot: index(slot),
                    }),
                );
            }
            if let Some(slot) = find(time).filter(|_| layout.free_initial_time) {
                let term = Term::Rate {
                    point: index(point),
                    slot: index(slot),
                };
                self.push(row, layout.initial_time(), Some(term));
            }
            if layout.free_duration && sparsity.active[r] {
                let term = Term::RateByDuration {
                    point: index(point),
                    row: index(r),
                };
                self.push(row, layout.duration(), Some(term));
            }
            for (variable, side) in evaluation.grid.sides(point).filter(|_| sparsity.active[r]) {
                let term = Term::RateByKnot {
                    point: index(point),
                    row: index(r),
                    side,
                };
                self.push(row, variable, Some(term));
            }
            slot += inputs.len();
        }
    }

    fn path(&mut self, layout: &Layout, evaluation: &Evaluation<'_>, point: usize) {
        let sparsity = evaluation.node_derivatives().sparsity();
        let mut slot = first_slot(sparsity, layout.states);
        for p in 0..layout.path {
            let row = layout.path(point, p);
            for &input in &sparsity.jacobian[layout.states + p] {
                if input == evaluation.node.time() {
                    if layout.free_initial_time {
                        let term = Term::Path {
                            point: index(point),
                            slot: index(slot),
                        };
                        self.push(row, layout.initial_time(), Some(term));
                    }
                    // The first point stands at t₀ whatever the duration.
                    if layout.free_duration && evaluation.fraction(point) > 0.0 {
                        let term = Term::PathByDuration {
                            point: index(point),
                            slot: index(slot),
                        };
                        self.push(row, layout.duration(), Some(term));
                    }
                } else {
                    self.push(
                        row,
                        layout.input(point, input),
                        Some(Term::Path {
                            point: index(point),
                            slot: index(slot),
                        }),
                    );
                }
                slot += 1;
            }
        }
    }

    /// Rows of the way-point at the node `point`, where there is one.
    fn way_points(&mut self, layout: &Layout, evaluation: &Evaluation<'_>, point: usize) {
        let here = layout.way_point_nodes().position(|node| node == point);
        let Some(way_point) = here else { return };
        let evaluated = &evaluation.way_points[way_point];
        let mut slot = 0;
        for (r, inputs) in evaluated.sparsity().jacobian.iter().enumerate() {
            let row = layout.way_point(way_point, r);
            for &input in inputs {
                let term = Term::WayPoint {
                    way_point: index(way_point),
                    slot: index(slot),
                };
                self.push(row, evaluated.columns[input], Some(term));
                slot += 1;
            }
        }
    }

    fn boundary(&mut self, layout: &Layout, evaluation: &Evaluation<'_>) {
        let mut slot = 0;
        for b in 0..layout.boundary {
            for &input in &evaluation.end_derivatives.sparsity().jacobian[b] {
                let column = end_column(layout, input);
                self.push(
                    layout.boundary(b),
                    column,
                    Some(Term::End { slot: index(slot) }),
                );
                slot += 1;
            }
        }
    }

    /// The row of integral `i`: its value less the quadrature of its integrand.
    fn integral(&mut self, layout: &Layout, evaluation: &Evaluation<'_>, i: usize) {
        let sparsity = evaluation.node_derivatives().sparsity();
        let time = evaluation.node.time();
        let output = evaluation.node.cost() + 1 + i;
        let first = first_slot(sparsity, output);
        let inputs = &sparsity.jacobian[output];
        let row = layout.integral_row(i);
        self.push_constant(row, layout.integral(i), 1.0);
        // Columns of the border have a term from every point.
        let mut shared: BTreeMap<usize, Vec<Term>> = BTreeMap::new();
        let border = layout.border();
        for point in 0..layout.points {
            for (slot, &input) in (first..).zip(inputs) {
                let term = Term::Integrand {
                    point: index(point),
                    slot: index(slot),
                };
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
                    self.push(row, column, Some(term));
                }
            }
            if layout.free_duration && sparsity.active[output] {
                let term = Term::IntegrandByDuration {
                    point: index(point),
                    output: index(output),
                };
                shared.entry(layout.duration()).or_default().push(term);
            }
            for (variable, side) in evaluation.grid.sides(point) {
                let term = Term::IntegrandByKnot {
                    point: index(point),
                    output: index(output),
                    side,
                };
                shared.entry(variable).or_default().push(term);
            }
        }
        for (column, terms) in shared {
            let nonzero = self.push(row, column, None);
            self.terms
                .extend(terms.into_iter().map(|term| (nonzero, term)));
        }
    }
}
