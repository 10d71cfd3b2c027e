//! Structure and values of the gradient and the constraint Jacobian.

use super::evaluation::Evaluation;
use super::{Discretization, Layout};
use crate::autodiff::Sparsity;
use crate::collocation::Mesh;
use crate::ocp::{Formulation, Ocp};
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
}

/// The constraint Jacobian of a transcription: triplets, constant parts and terms to add.
#[derive(Debug)]
pub(super) struct Jacobian {
    pub rows: Vec<usize>,
    pub columns: Vec<usize>,
    constant: Vec<f64>,
    /// (nonzero, term), in the order of the nonzeros.
    terms: Vec<(usize, Term)>,
    /// width/2 of the segment of each point.
    half_width: Vec<f64>,
    /// Quadrature weight of each point.
    quadrature: Vec<f64>,
}

impl Jacobian {
    pub fn new<O: Ocp>(layout: &Layout, mesh: &Mesh, evaluation: &Evaluation<'_, O>) -> Self {
        let mut jacobian = Self {
            rows: Vec::new(),
            columns: Vec::new(),
            constant: Vec::new(),
            terms: Vec::new(),
            half_width: half_widths(mesh),
            quadrature: quadrature(mesh),
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
        let first = |point: usize, slot: usize| evaluation.first[point * width + slot];
        for &(nonzero, term) in &self.terms {
            values[nonzero] += match term {
                Term::Rate { point, slot } => {
                    -duration * self.half_width[point] * first(point, slot)
                }
                Term::RateByDuration { point, row, time } => {
                    let by_time = time.map_or(0.0, |slot| {
                        duration * evaluation.fraction(point) * first(point, slot)
                    });
                    -self.half_width[point] * (evaluation.outputs(point)[row] + by_time)
                }
                Term::Path { point, slot } => first(point, slot),
                Term::PathByDuration { point, slot } => {
                    evaluation.fraction(point) * first(point, slot)
                }
                Term::End { slot } => evaluation.end_first[slot],
                Term::WayPoint { way_point, slot } => evaluation.way_points[way_point].first[slot],
                Term::Integrand { point, slot } => {
                    -duration * self.quadrature[point] * first(point, slot)
                }
                Term::IntegrandByDuration {
                    point,
                    output,
                    time,
                } => {
                    let by_time = time.map_or(0.0, |slot| {
                        duration * evaluation.fraction(point) * first(point, slot)
                    });
                    -self.quadrature[point] * (evaluation.outputs(point)[output] + by_time)
                }
            };
        }
    }
}

/// Objective (25): terminal cost and quadrature of the running cost.
pub(super) fn objective<O: Ocp>(
    duration: f64,
    quadrature: &[f64],
    evaluation: &Evaluation<'_, O>,
) -> f64 {
    let cost = evaluation.node.cost();
    let integral: f64 = quadrature
        .iter()
        .enumerate()
        .map(|(k, w)| w * evaluation.outputs(k)[cost])
        .sum();
    evaluation.end_values[evaluation.ends.rows] + duration * integral
}

/// Gradient of the objective, dense.
pub(super) fn gradient<O: Ocp>(
    duration: f64,
    quadrature: &[f64],
    layout: &Layout,
    evaluation: &Evaluation<'_, O>,
    gradient: &mut [f64],
) {
    gradient.fill(0.0);
    let sparsity = evaluation.node_derivatives().sparsity();
    let cost = evaluation.node.cost();
    let inputs = &sparsity.jacobian[cost];
    let offset = first_slot(sparsity, cost);
    for (k, w) in quadrature.iter().enumerate() {
        let first = &evaluation.nonzeros(k)[offset..];
        for (&input, d) in inputs.iter().zip(first) {
            if input != evaluation.node.time() {
                gradient[layout.input(k, input)] += duration * w * d;
                continue;
            }
            if layout.free_duration {
                gradient[layout.duration()] += duration * w * evaluation.fraction(k) * d;
            }
            if layout.free_initial_time {
                gradient[layout.initial_time()] += duration * w * d;
            }
        }
        if layout.free_duration {
            gradient[layout.duration()] += w * evaluation.outputs(k)[cost];
        }
    }
    let inputs = &evaluation.end_derivatives.sparsity().jacobian[evaluation.ends.rows];
    let offset = evaluation.end_derivatives.jacobian_nonzeros() - inputs.len();
    for (&input, d) in inputs.iter().zip(&evaluation.end_first[offset..]) {
        gradient[end_column(layout, input)] += d;
    }
}

/// Value of each integral of `ocp` on `trajectory`, by the quadrature of its mesh.
pub fn integrals<O: Ocp>(
    ocp: &O,
    formulation: &Formulation,
    trajectory: &Discretization,
) -> Vec<f64> {
    let mut sums = vec![0.0; formulation.integrals.len()];
    if sums.is_empty() {
        return sums;
    }
    let mut scratch = ocp.scratch::<f64>();
    let mut rates = vec![0.0; formulation.states.len()];
    let mut path = vec![0.0; formulation.path.len()];
    let mut integrands = vec![0.0; sums.len()];
    let times = trajectory.times();
    for (k, weight) in quadrature(&trajectory.mesh).into_iter().enumerate() {
        let point = trajectory.point(trajectory.state(k), trajectory.control(k), times[k]);
        ocp.continuous(point, &mut scratch, &mut rates, &mut path);
        ocp.integrands(point, &mut scratch, &mut integrands);
        for (sum, value) in sums.iter_mut().zip(&integrands) {
            *sum += trajectory.duration * weight * value;
        }
    }
    sums
}

/// The first nonzero of `output` among those of a function's Jacobian.
fn first_slot(sparsity: &Sparsity, output: usize) -> usize {
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

/// width/2 of the segment of each point, fraction of the duration.
pub(super) fn half_widths(mesh: &Mesh) -> Vec<f64> {
    (0..mesh.segments())
        .flat_map(|s| std::iter::repeat_n(0.5 * mesh.width(s), mesh.rule(s).len()))
        .collect()
}

/// Quadrature weight of each point, fraction of the duration; sum 1.
pub(super) fn quadrature(mesh: &Mesh) -> Vec<f64> {
    (0..mesh.segments())
        .flat_map(|s| {
            mesh.rule(s)
                .weights()
                .iter()
                .map(move |w| 0.5 * mesh.width(s) * w)
        })
        .collect()
}

/// Programme variables of a discretization whose integrals have these values.
pub(super) fn pack(layout: &Layout, from: &Discretization, integrals: &[f64]) -> Vec<f64> {
    let mut x = vec![0.0; layout.variables()];
    for k in 0..=layout.points {
        let start = layout.state(k, 0);
        x[start..start + layout.states].copy_from_slice(from.state(k));
        if k < layout.points {
            let start = layout.control(k, 0);
            x[start..start + layout.controls].copy_from_slice(from.control(k));
        }
    }
    if layout.free_duration {
        x[layout.duration()] = from.duration;
    }
    if layout.free_initial_time {
        x[layout.initial_time()] = from.initial_time;
    }
    x[layout.parameter(0)..layout.integral(0)].copy_from_slice(&from.parameters);
    x[layout.integral(0)..].copy_from_slice(integrals);
    x
}
