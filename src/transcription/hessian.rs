//! Structure and values of the Hessian of the Lagrangian.

use super::Layout;
use super::evaluation::Evaluation;
use super::grid::Grid;
use super::jacobian::end_column;
use super::triplets::{Triplets, index};
use crate::nlp::Undefined;
use std::collections::HashMap;

/// Second derivatives of one point that involve the duration T through t = t₀ + αT and the factor
/// T·width/2, or t₀ through t. Indices into the point's own derivatives.
#[derive(Debug, Default)]
struct TimeTerms {
    /// (input, slot in the programme's Hessian for (T, input)), one list a point.
    coupling: Vec<Vec<(usize, usize)>>,
    /// Slot of (T, T), where the problem depends on time.
    own: Option<usize>,
    /// (nonzero of the point's block, slot for (t₀, input) or (t₀, t₀)), one list a point.
    initial: Vec<Vec<(usize, usize)>>,
    /// Slot of (t₀, T), where both are free and the problem depends on time.
    cross: Option<usize>,
}

/// Second derivatives of one point that involve a free breakpoint beside it, through the factor
/// T·width/2: one list a point.
#[derive(Debug, Default)]
struct KnotTerms {
    /// (input, slot, side).
    coupling: Vec<Vec<(usize, usize, i8)>>,
    /// With the duration, where that is free: (slot, side).
    duration: Vec<Vec<(usize, i8)>>,
}

/// What the Lagrangian σf + Σ λg is made with.
#[derive(Debug, Clone, Copy)]
pub(super) struct Multipliers<'a> {
    /// σ, of the objective.
    pub objective: f64,
    /// λ, of the rows.
    pub rows: &'a [f64],
}

/// The slot of what has none.
const NONE: u32 = u32::MAX;

/// The lower triangle of ∇²L: triplets and where each point's block goes.
#[derive(Debug)]
pub(super) struct Hessian {
    layout: Layout,
    pub places: Triplets,
    /// Slot of each nonzero of each point's block; [`NONE`] where it involves the time.
    node_slots: Vec<u32>,
    end_slots: Vec<usize>,
    /// Slots and block of each way-point.
    way_points: Vec<(Vec<usize>, Vec<f64>)>,
    time: TimeTerms,
    knots: KnotTerms,
    /// Weights of every point's outputs, by points.
    weights: Vec<f64>,
    /// Nonzeros of every point's weighted Hessian, by points.
    blocks: Vec<f64>,
    end_weights: Vec<f64>,
    end_block: Vec<f64>,
    by_input: Vec<f64>,
}

impl Hessian {
    pub fn new(layout: &Layout, evaluation: &Evaluation<'_>) -> Self {
        let sparsity = evaluation.node_derivatives().sparsity();
        let time = evaluation.node.time();
        let mut slots = Slots::default();
        let mut node_slots = Vec::with_capacity(layout.points * sparsity.hessian.len());
        for k in 0..layout.points {
            for &(i, j) in &sparsity.hessian {
                let own = layout.is_own(k, i) && layout.is_own(k, j);
                node_slots.push(if i == time {
                    NONE
                } else if own {
                    index(slots.new_slot(layout.input(k, i), layout.input(k, j)))
                } else {
                    index(slots.slot(layout.input(k, i), layout.input(k, j)))
                });
            }
        }
        let end_slots = evaluation
            .end_derivatives
            .sparsity()
            .hessian
            .iter()
            .map(|&(i, j)| {
                let (a, b) = (end_column(layout, i), end_column(layout, j));
                slots.either(a, b)
            })
            .collect();
        let way_points = evaluation
            .way_points
            .iter()
            .map(|point| {
                let place = |&(i, j): &(usize, usize)| {
                    let (a, b) = (point.columns[i], point.columns[j]);
                    slots.either(a, b)
                };
                let slots: Vec<usize> = point.sparsity().hessian.iter().map(place).collect();
                let block = vec![0.0; slots.len()];
                (slots, block)
            })
            .collect();
        let terms = TimeTerms::new(layout, evaluation, &mut slots);
        let knots = KnotTerms::new(layout, evaluation, &mut slots);
        Self {
            layout: layout.clone(),
            places: slots.close(),
            node_slots,
            end_slots,
            way_points,
            time: terms,
            knots,
            weights: vec![0.0; layout.points * sparsity.jacobian.len()],
            blocks: vec![0.0; layout.points * sparsity.hessian.len()],
            end_weights: vec![0.0; evaluation.end_values.len()],
            end_block: vec![0.0; evaluation.end_derivatives.sparsity().hessian.len()],
            by_input: vec![0.0; time + 1],
        }
    }

    /// Values of σ∇²f + Σ λ∇²g. Where the duration or a breakpoint is free, values and first
    /// derivatives must be current.
    pub fn values(
        &mut self,
        x: &[f64],
        multipliers: Multipliers<'_>,
        evaluation: &mut Evaluation<'_>,
        values: &mut [f64],
    ) -> Result<(), Undefined> {
        values.fill(0.0);
        let duration = evaluation.duration(x);
        for k in 0..self.layout.points {
            self.weigh(k, duration, &evaluation.grid, multipliers);
        }
        evaluation.node_hessians(x, &self.weights, &mut self.blocks);
        for (h, &slot) in self.blocks.iter().zip(&self.node_slots) {
            if slot != NONE {
                values[slot as usize] += h;
            }
        }
        if self.layout.free_duration {
            for k in 0..self.layout.points {
                self.duration_terms(k, duration, evaluation, values);
            }
        }
        if evaluation.grid.is_free() {
            for k in 0..self.layout.points {
                self.knot_terms(k, duration, evaluation, values);
            }
        }
        let width = evaluation.node_derivatives().sparsity().hessian.len();
        for (k, initial) in self.time.initial.iter().enumerate() {
            for &(nonzero, slot) in initial {
                values[slot] += self.blocks[k * width + nonzero];
            }
        }
        let layout = &self.layout;
        let (end_rows, end_cost) = self.end_weights.split_at_mut(layout.boundary);
        let boundary = layout.boundary(0)..layout.integral_row(0);
        end_rows.copy_from_slice(&multipliers.rows[boundary]);
        end_cost[0] = multipliers.objective;
        evaluation.end_hessian(x, &self.end_weights, &mut self.end_block);
        for (h, &slot) in self.end_block.iter().zip(&self.end_slots) {
            values[slot] += h;
        }
        for (w, (slots, block)) in self.way_points.iter_mut().enumerate() {
            let first = layout.way_point(w, 0);
            let rows = evaluation.way_points[w].values.len();
            let weights = &multipliers.rows[first..first + rows];
            evaluation.way_point_hessian(w, x, weights, block);
            for (h, &slot) in block.iter().zip(slots.iter()) {
                values[slot] += h;
            }
        }
        if values.iter().all(|h| h.is_finite()) {
            Ok(())
        } else {
            Err(Undefined {
                function: "Hessian of the Lagrangian",
            })
        }
    }

    /// Weights of point `k`'s outputs in the Lagrangian.
    fn weigh(&mut self, k: usize, duration: f64, grid: &Grid, multipliers: Multipliers<'_>) {
        let layout = &self.layout;
        let cost = layout.states + layout.path;
        let outputs = cost + 1 + layout.integrals;
        let half = duration * grid.half_width[k];
        let weights = &mut self.weights[k * outputs..(k + 1) * outputs];
        let first = layout.defect(k, 0);
        let rows = &multipliers.rows[first..first + layout.states + layout.path];
        for (i, (weight, &multiplier)) in weights.iter_mut().zip(rows).enumerate() {
            *weight = if i < layout.states {
                -half * multiplier
            } else {
                multiplier
            };
        }
        weights[cost] = multipliers.objective * duration * grid.quadrature[k];
        let integrals = &multipliers.rows[layout.integral_row(0)..layout.final_time_row()];
        for (weight, multiplier) in weights[cost + 1..].iter_mut().zip(integrals) {
            *weight = -(duration * grid.quadrature[k]) * multiplier;
        }
    }

    /// Second derivatives with the duration: with ψ = T·g(v, t) + c(v, t) and t = t₀ + αT, where g
    /// gathers defects, cost and integrals, ψ_vT = g_v + αT·g_vt + α·c_vt,
    /// ψ_TT = 2α·g_t + α²(T·g_tt + c_tt) and ψ_t₀T = g_t + α(T·g_tt + c_tt).
    fn duration_terms(
        &mut self,
        k: usize,
        duration: f64,
        evaluation: &Evaluation<'_>,
        values: &mut [f64],
    ) {
        let layout = &self.layout;
        let sparsity = evaluation.node_derivatives().sparsity();
        let time = evaluation.node.time();
        let alpha = evaluation.fraction(k);
        self.by_input.fill(0.0);
        let outputs = sparsity.jacobian.len();
        let weights = &self.weights[k * outputs..(k + 1) * outputs];
        let width = sparsity.hessian.len();
        let block = &self.blocks[k * width..(k + 1) * width];
        let mut first = evaluation.nonzeros(k).iter();
        for (r, inputs) in sparsity.jacobian.iter().enumerate() {
            let scaled = !(layout.states..layout.states + layout.path).contains(&r);
            let weight = if scaled { weights[r] / duration } else { 0.0 };
            for (&input, d) in inputs.iter().zip(first.by_ref()) {
                self.by_input[input] += weight * d;
            }
        }
        let mut own = 2.0 * alpha * self.by_input[time];
        let mut cross = self.by_input[time];
        for (h, &(i, j)) in block.iter().zip(&sparsity.hessian) {
            if i == time && j == time {
                own += alpha * alpha * h;
                cross += alpha * h;
            } else if i == time {
                self.by_input[j] += alpha * h;
            }
        }
        for &(input, slot) in &self.time.coupling[k] {
            values[slot] += self.by_input[input];
        }
        if let Some(slot) = self.time.own {
            values[slot] += own;
        }
        if let Some(slot) = self.time.cross {
            values[slot] += cross;
        }
    }
}

impl Hessian {
    /// Second derivatives with the free breakpoints beside a point: with ψ = (TW/2)·g(v), W being
    /// the width, ψ_Wv = (T/2)·g_v and ψ_WT = g/2; the width changes by side with the breakpoint.
    fn knot_terms(
        &mut self,
        k: usize,
        duration: f64,
        evaluation: &Evaluation<'_>,
        values: &mut [f64],
    ) {
        if self.knots.coupling[k].is_empty() {
            return;
        }
        let layout = &self.layout;
        let sparsity = evaluation.node_derivatives().sparsity();
        let width = 2.0 * evaluation.grid.half_width[k];
        self.by_input.fill(0.0);
        let outputs = sparsity.jacobian.len();
        let weights = &self.weights[k * outputs..(k + 1) * outputs];
        let mut first = evaluation.nonzeros(k).iter();
        let mut sum = 0.0;
        for (r, inputs) in sparsity.jacobian.iter().enumerate() {
            let scaled = !(layout.states..layout.states + layout.path).contains(&r);
            let weight = if scaled { weights[r] / width } else { 0.0 };
            sum += weight * evaluation.outputs(k)[r];
            for (&input, d) in inputs.iter().zip(first.by_ref()) {
                self.by_input[input] += weight * d;
            }
        }
        for &(input, slot, side) in &self.knots.coupling[k] {
            values[slot] += f64::from(side) * self.by_input[input];
        }
        if layout.free_duration {
            for &(slot, side) in &self.knots.duration[k] {
                values[slot] += f64::from(side) * sum / duration;
            }
        }
    }
}

impl KnotTerms {
    fn new(layout: &Layout, evaluation: &Evaluation<'_>, slots: &mut Slots) -> Self {
        let mut terms = Self::default();
        if !evaluation.grid.is_free() {
            return terms;
        }
        for k in 0..layout.points {
            let inputs = coupled_inputs(layout, evaluation, k);
            let mut coupling = Vec::new();
            let mut duration = Vec::new();
            for (variable, side) in evaluation.grid.sides(k) {
                for &input in &inputs {
                    let slot = slots.either(variable, layout.input(k, input));
                    coupling.push((input, slot, side));
                }
                if layout.free_duration {
                    duration.push((slots.either(variable, layout.duration()), side));
                }
            }
            terms.coupling.push(coupling);
            terms.duration.push(duration);
        }
        terms
    }
}

impl TimeTerms {
    fn new(layout: &Layout, evaluation: &Evaluation<'_>, slots: &mut Slots) -> Self {
        let sparsity = evaluation.node_derivatives().sparsity();
        let time = evaluation.node.time();
        let depends = sparsity.columns().contains(&time);
        let mut terms = Self::default();
        if layout.free_duration {
            let last = layout.duration();
            terms.coupling = (0..layout.points)
                .map(|k| {
                    coupled_inputs(layout, evaluation, k)
                        .into_iter()
                        .map(|i| (i, slots.either(last, layout.input(k, i))))
                        .collect()
                })
                .collect();
            terms.own = depends.then(|| slots.slot(last, last));
        }
        if layout.free_initial_time {
            let first = layout.initial_time();
            let of_time = || sparsity.hessian.iter().enumerate();
            terms.initial = (0..layout.points)
                .map(|k| {
                    of_time()
                        .filter(|(_, (i, _))| *i == time)
                        .map(|(nonzero, &(_, j))| match j == time {
                            true => (nonzero, slots.slot(first, first)),
                            false => (nonzero, slots.either(first, layout.input(k, j))),
                        })
                        .collect()
                })
                .collect();
            let both = depends && layout.free_duration;
            terms.cross = both.then(|| slots.either(first, layout.duration()));
        }
        terms
    }
}

/// Inputs of point `k` with a second derivative by the duration. Path rows do not carry the factor
/// T: they couple with it through the time alone, which the first point does not.
fn coupled_inputs(layout: &Layout, evaluation: &Evaluation<'_>, k: usize) -> Vec<usize> {
    let sparsity = evaluation.node_derivatives().sparsity();
    let time = evaluation.node.time();
    let path = layout.states..layout.states + layout.path;
    let scaled = (0..sparsity.jacobian.len()).filter(|r| !path.contains(r));
    let by_time = sparsity
        .hessian
        .iter()
        .filter(|&&(i, _)| i == time && evaluation.fraction(k) > 0.0);
    let mut inputs: Vec<usize> = scaled
        .flat_map(|r| sparsity.jacobian[r].iter().copied())
        .chain(by_time.map(|&(_, j)| j))
        .filter(|&input| input != time)
        .collect();
    inputs.sort_unstable();
    inputs.dedup();
    inputs
}

/// Triplets without repetition.
#[derive(Default)]
struct Slots {
    places: Triplets,
    known: HashMap<(usize, usize), usize>,
}

impl Slots {
    /// The slot of two variables in the lower triangle.
    fn either(&mut self, a: usize, b: usize) -> usize {
        self.slot(a.max(b), a.min(b))
    }

    fn slot(&mut self, row: usize, column: usize) -> usize {
        if let Some(&slot) = self.known.get(&(row, column)) {
            return slot;
        }
        let slot = self.new_slot(row, column);
        self.known.insert((row, column), slot);
        slot
    }

    /// The slot of a pair that is never asked for again.
    fn new_slot(&mut self, row: usize, column: usize) -> usize {
        self.places.push(row, column)
    }

    /// All of them.
    fn close(mut self) -> Triplets {
        self.places.close();
        self.places
    }
}
