//! Where derivatives of points and ends stand.

use crate::autodiff::Sparsity;
use crate::transcription::Layout;

/// The first nonzero of `output` among those of a function's Jacobian.
pub(in crate::transcription) fn first_slot(sparsity: &Sparsity, output: usize) -> usize {
    sparsity.jacobian[..output].iter().map(Vec::len).sum()
}

/// Variable behind an input of the boundary function (x(t₀), x(t_f), p, q, t₀, T).
pub(in crate::transcription) fn end_column(layout: &Layout, input: usize) -> usize {
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
