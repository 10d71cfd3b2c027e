//! Structure and values of the constraint Jacobian.

use super::Layout;
use super::evaluation::Evaluation;
use super::structure::LinearRow;
use super::triplets::{Triplets, index};
use crate::autodiff::Sparsity;
use crate::collocation::Mesh;
use crate::ocp::Ocp;
use std::collections::BTreeMap;

/// What a nonzero of the Jacobian is made of, beyond its constant part. In 32 bits: large meshes have
/// hundreds of thousands.
#[derive(Debug, Clone, Copy)]
enum Term {
    /// −(T·width/2)·(derivative `slot` of the point).
    Rate { point: u32, slot: u32 },
    /// −(width/2)·f_row − (T·width/2)·α·(time derivative, where there is one).
    RateByDuration { point: u32, row: u32 },
    /// Derivative `slot` of the point as it is.
    Path { point: u32, slot: u32 },
    /// α·(time derivative of a path row).
    PathByDuration { point: u32, slot: u32 },
    /// Derivative `slot` of the ends.
    End { slot: u32 },
    /// Derivative `slot` of a way-point.
    WayPoint { way_point: u32, slot: u32 },
    /// −(T·quadrature weight)·(derivative `slot` of the point).
    Integrand { point: u32, slot: u32 },
    /// −(quadrature weight)·(g_output + T·α·(time derivative, where there is one)).
    IntegrandByDuration { point: u32, output: u32 },
    /// −side·(T/2)·f_row: by a free breakpoint at the start (−1) or the end (+1) of the segment.
    RateByKnot { point: u32, row: u32, side: i8 },
    /// −side·(T/2)·(weight of the rule)·g_output.
    IntegrandByKnot { point: u32, output: u32, side: i8 },
}

/// The constraint Jacobian of a transcription: constant parts and terms to add.
#[derive(Debug)]
pub(super) struct Jacobian {
    pub nonzeros: usize,
    /// The first nonzero of every row (26), by points. With those after it, it has the coefficients of the
    /// differentiation matrix.
    defects: Vec<u32>,
    /// Other constant parts: nonzero and value.
    constants: Vec<(u32, f64)>,
    /// (nonzero, term), in the order of the nonzeros.
    terms: Vec<(u32, Term)>,
    /// Which derivative of the point is that of each output by the time.
    by_time: Vec<Option<usize>>,
}

/// The Jacobian and the places of its nonzeros, as they are put together.
struct Builder {
    places: Triplets,
    jacobian: Jacobian,
}

/// What a Jacobian is made from.
pub(super) struct Parts<'p, 'a, O: Ocp> {
    pub layout: &'p Layout,
    pub mesh: &'p Mesh,
    pub structural: &'p [LinearRow],
    pub evaluation: &'p Evaluation<'a, O>,
}

impl Builder {
    fn build<O: Ocp>(parts: &Parts<'_, '_, O>) -> Self {
        let Parts {
            layout,
            mesh,
            structural,
            evaluation,
        } = *parts;
        let sparsity = evaluation.node_derivatives().sparsity();
        let time = evaluation.node.time();
        let by_time = |output: usize| {
            let inputs = &sparsity.jacobian[output];
            let time = inputs.iter().position(|&input| input == time);
            time.map(|k| first_slot(sparsity, output) + k)
        };
        let mut builder = Self {
            places: Triplets::default(),
            jacobian: Jacobian {
                nonzeros: 0,
                defects: Vec::with_capacity(layout.points * layout.states),
                constants: Vec::new(),
                terms: Vec::new(),
                by_time: (0..sparsity.jacobian.len()).map(by_time).collect(),
            },
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
        builder.jacobian.nonzeros = builder.places.len();
        builder.jacobian.terms.shrink_to_fit();
        builder
    }

    fn push(&mut self, row: usize, column: usize, term: Option<Term>) -> u32 {
        let nonzero = index(self.places.push(row, column));
        if let Some(term) = term {
            self.jacobian.terms.push((nonzero, term));
        }
        nonzero
    }

    fn push_constant(&mut self, row: usize, column: usize, value: f64) {
        let nonzero = self.push(row, column, None);
        self.jacobian.constants.push((nonzero, value));
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
            self.jacobian.defects.push(index(self.places.len()));
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

    fn path<O: Ocp>(&mut self, layout: &Layout, evaluation: &Evaluation<'_, O>, point: usize) {
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
                let term = Term::WayPoint {
                    way_point: index(way_point),
                    slot: index(slot),
                };
                self.push(row, evaluated.columns[input], Some(term));
                slot += 1;
            }
        }
    }

    fn boundary<O: Ocp>(&mut self, layout: &Layout, evaluation: &Evaluation<'_, O>) {
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
    fn integral<O: Ocp>(&mut self, layout: &Layout, evaluation: &Evaluation<'_, O>, i: usize) {
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
            self.jacobian
                .terms
                .extend(terms.into_iter().map(|term| (nonzero, term)));
        }
    }
}

impl Jacobian {
    pub fn new<O: Ocp>(parts: &Parts<'_, '_, O>) -> Self {
        Builder::build(parts).jacobian
    }

    /// Rows and columns of the nonzeros. They are asked for as a solve begins, and not kept: Ipopt has its
    /// own copy.
    pub fn places<O: Ocp>(parts: &Parts<'_, '_, O>) -> Triplets {
        Builder::build(parts).places
    }

    pub fn values<O: Ocp>(
        &self,
        duration: f64,
        mesh: &Mesh,
        evaluation: &Evaluation<'_, O>,
        values: &mut [f64],
    ) {
        values.fill(0.0);
        self.differentiate(mesh, values);
        for &(nonzero, constant) in &self.constants {
            values[nonzero as usize] = constant;
        }
        let width = evaluation.node_derivatives().jacobian_nonzeros();
        let grid = &evaluation.grid;
        let first =
            |point: u32, slot: u32| evaluation.first[point as usize * width + slot as usize];
        let output = |point: u32, output: u32| evaluation.outputs(point as usize)[output as usize];
        let fraction = |point: u32| evaluation.fraction(point as usize);
        let half_width = |point: u32| grid.half_width[point as usize];
        let quadrature = |point: u32| grid.quadrature[point as usize];
        // An output and, by the time, its derivative.
        let by_duration = |point: u32, row: u32| {
            let slot = self.by_time[row as usize];
            let by_time = slot.map_or(0.0, |slot| {
                duration * fraction(point) * evaluation.first[point as usize * width + slot]
            });
            output(point, row) + by_time
        };
        for &(nonzero, term) in &self.terms {
            values[nonzero as usize] += match term {
                Term::Rate { point, slot } => -duration * half_width(point) * first(point, slot),
                Term::RateByDuration { point, row } => -half_width(point) * by_duration(point, row),
                Term::Path { point, slot } => first(point, slot),
                Term::PathByDuration { point, slot } => fraction(point) * first(point, slot),
                Term::End { slot } => evaluation.end_first[slot as usize],
                Term::WayPoint { way_point, slot } => {
                    evaluation.way_points[way_point as usize].first[slot as usize]
                }
                Term::Integrand { point, slot } => {
                    -duration * quadrature(point) * first(point, slot)
                }
                Term::IntegrandByDuration { point, output } => {
                    -quadrature(point) * by_duration(point, output)
                }
                Term::RateByKnot { point, row, side } => {
                    -f64::from(side) * 0.5 * duration * output(point, row)
                }
                Term::IntegrandByKnot {
                    point,
                    output: row,
                    side,
                } => {
                    let half = 0.5 * duration * grid.weights[point as usize];
                    -f64::from(side) * half * output(point, row)
                }
            };
        }
    }

    /// Writes the coefficients of the differentiation matrix.
    fn differentiate(&self, mesh: &Mesh, values: &mut [f64]) {
        let points = (0..mesh.segments()).flat_map(|s| {
            let rule = mesh.rule(s);
            (0..rule.len()).map(|i| rule.differentiation(i))
        });
        let states = self.defects.len() / mesh.points().max(1);
        for (firsts, coefficients) in self.defects.chunks(states.max(1)).zip(points) {
            for &first in firsts {
                let first = first as usize;
                values[first..first + coefficients.len()].copy_from_slice(coefficients);
            }
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
