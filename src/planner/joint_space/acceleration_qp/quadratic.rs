//! A small convex quadratic programme with rows that give way only where they must.
//!
//! Ipopt solves it: it is there already, and takes a millisecond.

use crate::nlp::{Control, Iterate, Nlp, OptionValue, Settings, Size, Undefined, ipopt};
use crate::ocp::Interval;

/// Price of a unit by which a row gives way; far above any gain in the cost.
const PRICE: f64 = 1e4;

/// Minimise Σ wᵢ (Rᵢa − tᵢ)² within bounds on a and rows Ca.
#[derive(Debug, Clone, Default)]
pub(super) struct Quadratic {
    /// Rows of least squares: coefficients, target, weight.
    pub squares: Vec<(Vec<f64>, f64, f64)>,
    /// Bounds of every unknown, lower not above upper; hard.
    pub bounds: Vec<Interval>,
    /// Rows with their bounds, which hold exactly wherever that is possible.
    pub rows: Vec<(Vec<f64>, Interval)>,
}

impl Quadratic {
    /// The minimiser; `None` where the solver gives up.
    pub fn solve(&self) -> Option<Vec<f64>> {
        let n = self.bounds.len();
        if self.bounds.iter().all(|bound| bound.lower == bound.upper) {
            return Some(self.bounds.iter().map(|bound| bound.lower).collect());
        }
        let mut programme = Programme::new(self);
        let options = [
            // Bounds that are hard.
            ("bound_relax_factor", OptionValue::Real(0.0)),
            // Derivatives are asked for once.
            ("hessian_constant", OptionValue::Text("yes".into())),
            ("jac_d_constant", OptionValue::Text("yes".into())),
        ]
        .map(|(name, value)| (name.into(), value));
        let settings = Settings {
            timing: false,
            options: options.into(),
            ..Settings::default()
        };
        let mut start = vec![0.0; n + programme.rows.len()];
        for (x, bound) in start.iter_mut().zip(&self.bounds) {
            *x = bound.clamp(0.0);
        }
        let start = Iterate::primal(start);
        let solution = ipopt::solve(&mut programme, &settings, &start, &mut |_| {
            Control::Continue
        })
        .ok()?;
        solution.status.is_solved().then(|| {
            let mut x = solution.iterate.x;
            x.truncate(n);
            x
        })
    }
}

/// The programme as the solver sees it. Unknowns: a, then by how much each row gives way, s ≥ 0. A row
/// stands for two: Ca − s below the upper bound, Ca + s above the lower one.
struct Programme<'q> {
    of: &'q Quadratic,
    /// The rows with a bound.
    rows: Vec<&'q (Vec<f64>, Interval)>,
}

impl<'q> Programme<'q> {
    fn new(of: &'q Quadratic) -> Self {
        let rows = of.rows.iter().filter(|(_, bound)| !bound.is_free());
        Self {
            of,
            rows: rows.collect(),
        }
    }

    fn unknowns(&self) -> usize {
        self.of.bounds.len()
    }

    /// Rᵢa − tᵢ with Rᵢ and wᵢ.
    fn residuals<'x>(&'x self, x: &'x [f64]) -> impl Iterator<Item = (f64, &'x [f64], f64)> {
        let of_row = |(row, target, weight): &'x (Vec<f64>, f64, f64)| {
            (dot(row, x) - target, row.as_slice(), *weight)
        };
        self.of.squares.iter().map(of_row)
    }
}

impl Nlp for Programme<'_> {
    fn size(&self) -> Size {
        let (n, rows) = (self.unknowns(), self.rows.len());
        Size {
            variables: n + rows,
            constraints: 2 * rows,
            jacobian_nonzeros: 2 * rows * (n + 1),
            hessian_nonzeros: n * (n + 1) / 2,
        }
    }

    fn variable_bounds(&self, lower: &mut [f64], upper: &mut [f64]) {
        lower.fill(0.0);
        upper.fill(f64::INFINITY);
        let sides = lower.iter_mut().zip(upper);
        for ((lower, upper), bound) in sides.zip(&self.of.bounds) {
            (*lower, *upper) = (bound.lower, bound.upper);
        }
    }

    fn constraint_bounds(&self, lower: &mut [f64], upper: &mut [f64]) {
        lower.fill(f64::NEG_INFINITY);
        upper.fill(f64::INFINITY);
        for (k, (_, bound)) in self.rows.iter().enumerate() {
            upper[2 * k] = bound.upper;
            lower[2 * k + 1] = bound.lower;
        }
    }

    fn jacobian_structure(&self, rows: &mut [usize], columns: &mut [usize]) {
        let n = self.unknowns();
        for (k, (row, column)) in rows.iter_mut().zip(columns).enumerate() {
            *row = k / (n + 1);
            *column = match k % (n + 1) {
                last if last == n => n + *row / 2,
                column => column,
            };
        }
    }

    fn hessian_structure(&self, rows: &mut [usize], columns: &mut [usize]) {
        let lower = (0..self.unknowns()).flat_map(|row| (0..=row).map(move |column| (row, column)));
        for ((row, column), entry) in rows.iter_mut().zip(columns).zip(lower) {
            (*row, *column) = entry;
        }
    }

    fn new_point(&mut self) {}

    fn objective(&mut self, x: &[f64]) -> Result<f64, Undefined> {
        let squares: f64 = self.residuals(x).map(|(r, _, weight)| weight * r * r).sum();
        let given: f64 = x[self.unknowns()..].iter().sum();
        Ok(squares + PRICE * given)
    }

    fn gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<(), Undefined> {
        gradient.fill(0.0);
        for (residual, row, weight) in self.residuals(x) {
            for (slope, r) in gradient.iter_mut().zip(row) {
                *slope += 2.0 * weight * residual * r;
            }
        }
        gradient[self.unknowns()..].fill(PRICE);
        Ok(())
    }

    fn constraints(&mut self, x: &[f64], values: &mut [f64]) -> Result<(), Undefined> {
        let given = &x[self.unknowns()..];
        for (k, ((row, _), given)) in self.rows.iter().zip(given).enumerate() {
            let value = dot(row, x);
            values[2 * k] = value - given;
            values[2 * k + 1] = value + given;
        }
        Ok(())
    }

    fn jacobian(&mut self, _x: &[f64], values: &mut [f64]) -> Result<(), Undefined> {
        let n = self.unknowns();
        for (k, values) in values.chunks_exact_mut(n + 1).enumerate() {
            values[..n].copy_from_slice(&self.rows[k / 2].0);
            values[n] = if k % 2 == 0 { -1.0 } else { 1.0 };
        }
        Ok(())
    }

    fn hessian(
        &mut self,
        _x: &[f64],
        sigma: f64,
        _multipliers: &[f64],
        values: &mut [f64],
    ) -> Result<(), Undefined> {
        values.fill(0.0);
        for (row, _, weight) in &self.of.squares {
            let lower = (0..row.len()).flat_map(|i| (0..=i).map(move |j| (i, j)));
            for (value, (i, j)) in values.iter_mut().zip(lower) {
                *value += 2.0 * sigma * weight * row[i] * row[j];
            }
        }
        Ok(())
    }
}

/// Σ aᵢbᵢ over the shorter of the two.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quadratic() -> Quadratic {
        Quadratic {
            squares: vec![(vec![1.0, 0.0], 3.0, 1.0), (vec![0.0, 1.0], -1.0, 2.0)],
            bounds: vec![Interval::symmetric(2.0), Interval::FREE],
            rows: Vec::new(),
        }
    }

    fn close(found: &[f64], expected: [f64; 2]) {
        for (f, e) in found.iter().zip(expected) {
            assert!((f - e).abs() < 1e-6, "{found:?}, expected {expected:?}");
        }
    }

    #[test]
    fn bounds_hold() {
        close(&quadratic().solve().unwrap(), [2.0, -1.0]);
        let mut fixed = quadratic();
        fixed.bounds = vec![Interval::new(1.0, 1.0), Interval::new(-2.0, -2.0)];
        close(&fixed.solve().unwrap(), [1.0, -2.0]);
    }

    #[test]
    fn rows_hold_where_they_can_and_give_way_where_not() {
        let mut held = quadratic();
        // On x + y = 2: the gradients −2(3 − x) and 4(y + 1) meet at x = 8/3, beyond the bound.
        held.rows
            .push((vec![1.0, 1.0], Interval::new(2.0, f64::INFINITY)));
        close(&held.solve().unwrap(), [2.0, 0.0]);
        held.rows
            .push((vec![1.0, 0.0], Interval::new(5.0, f64::INFINITY)));
        close(&held.solve().unwrap(), [2.0, 0.0]);
        held.rows.push((vec![0.0, 1.0], Interval::new(-0.5, -0.5)));
        held.rows.remove(0);
        close(&held.solve().unwrap(), [2.0, -0.5]);
    }
}
