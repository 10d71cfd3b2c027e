//! The objective (25) and its gradient.

use super::Layout;
use super::evaluation::Evaluation;
use super::jacobian::{end_column, first_slot};

/// Objective (25): terminal cost and quadrature of the running cost.
pub(super) fn objective(duration: f64, evaluation: &Evaluation<'_>) -> f64 {
    let cost = evaluation.node.cost();
    let quadrature = &evaluation.grid.quadrature;
    let integral: f64 = quadrature
        .iter()
        .enumerate()
        .map(|(k, w)| w * evaluation.outputs(k)[cost])
        .sum();
    evaluation.end_values[evaluation.terminal_cost()] + duration * integral
}

/// Gradient of the objective, dense.
pub(super) fn gradient(
    duration: f64,
    layout: &Layout,
    evaluation: &Evaluation<'_>,
    gradient: &mut [f64],
) {
    gradient.fill(0.0);
    let sparsity = evaluation.node_derivatives().sparsity();
    let cost = evaluation.node.cost();
    let inputs = &sparsity.jacobian[cost];
    let offset = first_slot(sparsity, cost);
    let grid = &evaluation.grid;
    for (k, w) in grid.quadrature.iter().enumerate() {
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
        for (variable, side) in grid.sides(k) {
            let by_width = 0.5 * duration * grid.weights[k] * evaluation.outputs(k)[cost];
            gradient[variable] += f64::from(side) * by_width;
        }
    }
    let inputs = &evaluation.end_derivatives.sparsity().jacobian[evaluation.terminal_cost()];
    let offset = evaluation.end_first.len() - inputs.len();
    for (&input, d) in inputs.iter().zip(&evaluation.end_first[offset..]) {
        gradient[end_column(layout, input)] += d;
    }
}
