//! Equilibration: a symmetric scaling after which the largest entry of every column is near one.
//!
//! Threshold pivoting compares a pivot with the rest of its column. Where the unknowns of one column
//! differ by many orders of magnitude, as of variables at their bounds and far from them, that says
//! more about their units than about stability, and pivots are delayed for nothing.
//!
//! The scaling is that of D. Ruiz, *A scaling algorithm to equilibrate both rows and columns norms in
//! matrices* (RAL-TR-2001-034), rounded to powers of two, so that it is exact.

use super::Pattern;

/// Rounds of division by the roots of the columns' largest entries.
const ROUNDS: usize = 4;

/// A scaling and the matrix scaled by it.
#[derive(Debug, Clone, Default)]
pub(super) struct Scaling {
    /// What each unknown's row and column are multiplied by.
    pub factors: Vec<f64>,
    /// Values of the scaled matrix.
    pub values: Vec<f64>,
    /// Largest entry of each column.
    largest: Vec<f64>,
}

impl Scaling {
    /// Scales the matrix with these values.
    pub fn equilibrate(&mut self, pattern: &Pattern, values: &[f64]) {
        self.factors.clear();
        self.factors.resize(pattern.len(), 1.0);
        self.values.clear();
        self.values.extend_from_slice(values);
        for _ in 0..ROUNDS {
            self.largest.clear();
            self.largest.resize(pattern.len(), 0.0);
            for ((i, j), value) in pattern.entries().zip(&self.values) {
                self.largest[i] = self.largest[i].max(value.abs());
                self.largest[j] = self.largest[j].max(value.abs());
            }
            for (largest, factor) in self.largest.iter_mut().zip(&mut self.factors) {
                // A column of zeros stays as it is.
                let step = if *largest > 0.0 {
                    inverse_root(*largest)
                } else {
                    1.0
                };
                *largest = step;
                *factor *= step;
            }
            for ((i, j), value) in pattern.entries().zip(&mut self.values) {
                *value *= self.largest[i] * self.largest[j];
            }
        }
    }

    /// Scales a right-hand side, or a solution back.
    pub fn apply(&self, x: &mut [f64]) {
        for (x, factor) in x.iter_mut().zip(&self.factors) {
            *x *= factor;
        }
    }
}

/// A power of two near 1/√x, for x > 0.
fn inverse_root(x: f64) -> f64 {
    /// Bits of the fraction of a number, and the exponent that stands for 1.
    const FRACTION: u32 = f64::MANTISSA_DIGITS - 1;
    const ONE: u64 = f64::MAX_EXP as u64 - 1;
    let exponent = x.to_bits() >> FRACTION;
    f64::from_bits((ONE + ONE / 2 - exponent / 2) << FRACTION)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_of_any_size_have_largest_entries_near_one() {
        // A chain: sizes of the unknowns from 1e-9 to 1e9.
        let sizes: [f64; 4] = [1e-9, 1e-3, 1e4, 1e9];
        let pattern = Pattern::new(vec![0, 2, 4, 6, 7], vec![0, 1, 1, 2, 2, 3, 3]).unwrap();
        let entries = pattern.entries();
        let values: Vec<f64> = entries.map(|(i, j)| 3.0 * sizes[i] * sizes[j]).collect();
        let mut scaling = Scaling::default();
        scaling.equilibrate(&pattern, &values);
        for ((i, j), (value, scaled)) in pattern.entries().zip(values.iter().zip(&scaling.values)) {
            assert_eq!(value * scaling.factors[i] * scaling.factors[j], *scaled);
            if i == j {
                assert!((0.25..=4.0).contains(scaled), "{i}: {scaled}");
            }
        }
    }
}
