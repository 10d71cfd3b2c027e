//! Values within a step of [`Dop853`](super::Dop853), by a polynomial of degree seven.

use super::coefficients::{D, STAGES, combine};

/// Terms of the polynomial besides the state at the start.
const TERMS: usize = 7;

/// The polynomial of one step.
#[derive(Debug, Default)]
pub(super) struct Interpolation {
    /// Room for the state at the end of the step while further stages are taken.
    pub end: Vec<f64>,
    terms: [Vec<f64>; TERMS],
    value: Vec<f64>,
}

impl Interpolation {
    pub fn new(size: usize) -> Self {
        Self {
            end: vec![0.0; size],
            terms: std::array::from_fn(|_| vec![0.0; size]),
            value: vec![0.0; size],
        }
    }

    /// The polynomial of the step of length `h` between the states `start` and `end`, with all stages.
    pub fn load(&mut self, stages: &[f64], [start, end]: [&[f64]; 2], h: f64) {
        let size = start.len();
        let (first, last) = (&stages[..size], &stages[(STAGES - 1) * size..]);
        for k in 0..size {
            let moved = end[k] - start[k];
            self.terms[0][k] = moved;
            self.terms[1][k] = h * first[k] - moved;
            self.terms[2][k] = 2.0 * moved - h * (first[k] + last[k]);
        }
        for (term, row) in self.terms[3..].iter_mut().zip(D) {
            combine(row, stages, term);
            term.iter_mut().for_each(|value| *value *= h);
        }
    }

    /// The state at `part` of the step, which began at `start`.
    pub fn at(&mut self, part: f64, start: &[f64]) -> &[f64] {
        self.value.fill(0.0);
        for (k, term) in self.terms.iter().enumerate().rev() {
            let factor = if k % 2 == 0 { part } else { 1.0 - part };
            for (value, term) in self.value.iter_mut().zip(term) {
                *value = (*value + term) * factor;
            }
        }
        for (value, start) in self.value.iter_mut().zip(start) {
            *value += start;
        }
        &self.value
    }
}
