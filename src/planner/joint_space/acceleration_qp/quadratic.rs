//! A small convex quadratic programme with rows that give way only where they must.

use crate::ocp::Interval;
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};

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
        let soft: Vec<&(Vec<f64>, Interval)> =
            self.rows.iter().filter(|(_, b)| !b.is_free()).collect();
        // Unknowns: a, then by how much each row gives way.
        let size = n + soft.len();
        let mut p = vec![vec![0.0; size]; size];
        let mut q = vec![0.0; size];
        for (row, target, weight) in &self.squares {
            for i in 0..n {
                q[i] -= 2.0 * weight * target * row[i];
                // The solver reads the upper triangle only.
                for j in i..n {
                    p[i][j] += 2.0 * weight * row[i] * row[j];
                }
            }
        }
        q[n..].fill(PRICE);
        let mut a = Vec::new();
        let mut b = Vec::new();
        let mut push = |coefficients: &[f64], sign: f64, slack: Option<usize>, bound: f64| {
            if bound.is_finite() {
                let mut row = vec![0.0; size];
                for (value, c) in row.iter_mut().zip(coefficients) {
                    *value = sign * c;
                }
                if let Some(k) = slack {
                    row[n + k] = -1.0;
                }
                a.push(row);
                b.push(sign * bound);
            }
        };
        for (j, bound) in self.bounds.iter().enumerate() {
            let mut unit = vec![0.0; n];
            unit[j] = 1.0;
            push(&unit, 1.0, None, bound.upper);
            push(&unit, -1.0, None, bound.lower);
        }
        for (k, (row, bound)) in soft.iter().enumerate() {
            push(row, 1.0, Some(k), bound.upper);
            push(row, -1.0, Some(k), bound.lower);
            push(&[], 1.0, Some(k), 0.0);
        }
        let settings = DefaultSettings {
            verbose: false,
            // The price of a row that gives way makes the cost large, so that the solver's own
            // relative gap of 1e-8 would leave the unknowns with four digits.
            tol_gap_abs: 1e-12,
            tol_gap_rel: 1e-14,
            tol_feas: 1e-11,
            ..DefaultSettings::default()
        };
        let (p, a) = (CscMatrix::from(&p), rows(&a, size));
        let cones = [NonnegativeConeT(b.len())];
        let mut solver = DefaultSolver::new(&p, &q, &a, &b, &cones, settings).ok()?;
        solver.solve();
        let solution = &solver.solution;
        matches!(
            solution.status,
            SolverStatus::Solved | SolverStatus::AlmostSolved
        )
        .then(|| solution.x[..n].to_vec())
    }
}

/// A matrix of `width` columns, also where it has no rows.
fn rows(rows: &[Vec<f64>], width: usize) -> CscMatrix<f64> {
    if rows.is_empty() {
        CscMatrix::zeros((0, width))
    } else {
        CscMatrix::from(rows)
    }
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
    }
}
