//! Nonlinear least squares within bounds: a projected Levenberg-Marquardt method.
//!
//! C. Kanzow, N. Yamashita, M. Fukushima, doi:10.1016/j.cam.2004.02.013, with a damping parameter
//! that follows the gain ratio (K. Madsen, H. B. Nielsen, O. Tingleff, "Methods for non-linear
//! least squares problems", section 3.2).

use crate::numeric::largest_or_nan;
use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

/// Where the search ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Minimum {
    /// Variables, each from 0 to 1.
    pub z: Vec<f64>,
    /// Residuals there.
    pub residual: Vec<f64>,
    /// Jacobian there, one row a residual.
    pub jacobian: Vec<Vec<f64>>,
    /// Times the residuals were evaluated.
    pub evaluations: usize,
    /// Whether no step was left that reduces the residual; not where residuals or their derivatives
    /// are NaN.
    pub converged: bool,
}

impl Minimum {
    /// Sum of squares.
    pub fn sum(&self) -> f64 {
        sum_of_squares(&self.residual)
    }
}

/// Steps of the search.
const ITERATIONS: usize = 40;
/// Step of the difference quotients: far above the integrator's error, far below curvature.
const DIFFERENCE: f64 = 1e-4;
/// A search ends where a step gains less than this share of the sum of squares.
const GAIN: f64 = 1e-5;

/// Minimises ‖r(z)‖² over 0 ≤ z ≤ 1 from `start`. `residual` may fail, which ends the search
/// where it starts and shortens the step elsewhere.
///
/// # Errors
/// That of `residual` at the start.
pub fn minimise<E>(
    start: &[f64],
    residual: &mut impl FnMut(&[f64]) -> Result<Vec<f64>, E>,
) -> Result<Minimum, E> {
    let size = start.len();
    let mut at = Minimum {
        z: start.iter().map(|z| z.clamp(0.0, 1.0)).collect(),
        residual: Vec::new(),
        jacobian: Vec::new(),
        evaluations: 1,
        converged: false,
    };
    at.residual = residual(&at.z)?;
    let mut damping = 1e-3;
    let mut growth = 2.0;
    for _ in 0..ITERATIONS {
        differentiate(&mut at, residual);
        let gradient: Vec<f64> = (0..size)
            .map(|i| {
                at.jacobian
                    .iter()
                    .zip(&at.residual)
                    .map(|(row, r)| row[i] * r)
                    .sum()
            })
            .collect();
        // Variables that the gradient pushes against their bound stay there.
        let free: Vec<usize> = (0..size)
            .filter(|&i| {
                let (z, g) = (at.z[i], gradient[i]);
                !(z <= 0.0 && g > 0.0 || z >= 1.0 && g < 0.0)
            })
            .collect();
        let steepest = largest_or_nan(free.iter().map(|&i| gradient[i].abs()));
        if !(steepest.is_finite() && at.sum().is_finite()) {
            break;
        }
        if steepest <= 1e-10 * at.sum().max(1e-20) {
            at.converged = true;
            break;
        }
        let before = at.sum();
        let mut improved = false;
        for _ in 0..12 {
            let step = damped_step(&at.jacobian, &gradient, &free, damping);
            let mut z = at.z.clone();
            for (&i, step) in free.iter().zip(&step) {
                z[i] = (z[i] + step).clamp(0.0, 1.0);
            }
            at.evaluations += 1;
            let trial = residual(&z);
            let after = trial.as_ref().map_or(f64::INFINITY, |r| sum_of_squares(r));
            let moved = |i: usize| z[i] - at.z[i];
            let predicted = before - predicted_sum(&at, &moved);
            if let (Ok(r), true) = (trial, after < before) {
                let ratio = ((before - after) / predicted.max(1e-300)).min(1.0);
                damping *= (1.0 - (2.0 * ratio - 1.0).powi(3)).max(1.0 / 3.0);
                damping = damping.max(1e-12);
                growth = 2.0;
                (at.z, at.residual) = (z, r);
                improved = true;
                break;
            }
            damping *= growth;
            growth *= 2.0;
        }
        if !improved || before - at.sum() <= GAIN * before {
            at.converged = true;
            break;
        }
    }
    differentiate(&mut at, residual);
    Ok(at)
}

fn sum_of_squares(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}

/// ‖r + J(z' − z)‖².
fn predicted_sum(at: &Minimum, moved: &impl Fn(usize) -> f64) -> f64 {
    at.jacobian
        .iter()
        .zip(&at.residual)
        .map(|(row, r)| {
            let change: f64 = row.iter().enumerate().map(|(i, j)| j * moved(i)).sum();
            (r + change).powi(2)
        })
        .sum()
}

/// Difference quotients, towards the inside. A column that cannot be evaluated is zero.
fn differentiate<E>(at: &mut Minimum, residual: &mut impl FnMut(&[f64]) -> Result<Vec<f64>, E>) {
    let (rows, size) = (at.residual.len(), at.z.len());
    at.jacobian = vec![vec![0.0; size]; rows];
    for i in 0..size {
        let mut z = at.z.clone();
        let step = if z[i] > 0.5 { -DIFFERENCE } else { DIFFERENCE };
        z[i] += step;
        at.evaluations += 1;
        if let Ok(moved) = residual(&z) {
            for (k, row) in at.jacobian.iter_mut().enumerate() {
                row[i] = (moved[k] - at.residual[k]) / step;
            }
        }
    }
}

/// −(JᵀJ + μ·max diag)⁻¹ g in the free variables.
fn damped_step(jacobian: &[Vec<f64>], gradient: &[f64], free: &[usize], damping: f64) -> Vec<f64> {
    let size = free.len();
    let entry = |a: usize, b: usize| -> f64 { jacobian.iter().map(|row| row[a] * row[b]).sum() };
    let largest = free.iter().fold(0.0, |m: f64, &i| m.max(entry(i, i)));
    let matrix = Mat::from_fn(size, size, |i, j| {
        let shift = if i == j { damping * largest } else { 0.0 };
        entry(free[i], free[j]) + shift
    });
    let right = Mat::from_fn(size, 1, |i, _| -gradient[free[i]]);
    match matrix.llt(Side::Lower) {
        Ok(factors) => {
            let step = factors.solve(&right);
            (0..size).map(|i| step[(i, 0)]).collect()
        }
        // Only where everything is flat.
        Err(_) => vec![0.0; size],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solve(start: &[f64], r: impl Fn(&[f64]) -> Vec<f64>) -> Minimum {
        minimise(start, &mut |z: &[f64]| Ok::<_, ()>(r(z))).unwrap()
    }

    #[test]
    fn a_valley_is_followed_to_its_end() {
        // Rosenbrock's function on [−2, 2]².
        let r = |z: &[f64]| {
            let (x, y) = (4.0 * z[0] - 2.0, 4.0 * z[1] - 2.0);
            vec![10.0 * (y - x * x), 1.0 - x]
        };
        let found = solve(&[0.2, 0.75], r);
        assert!(found.sum() < 1e-10, "{found:?}");
        assert!((found.z[0] - 0.75).abs() < 1e-4 && (found.z[1] - 0.75).abs() < 1e-4);
    }

    #[test]
    fn a_bound_in_the_way_is_where_it_ends() {
        // The free minimum of a + b and a − b lies at a = 1.5, b = 0.4.
        let r = |z: &[f64]| vec![z[0] + z[1] - 1.9, z[0] - z[1] - 1.1];
        let found = solve(&[0.1, 0.9], r);
        assert_eq!(found.z[0], 1.0);
        assert!((found.z[1] - 0.4).abs() < 1e-6, "{found:?}");
        assert!((found.sum() - 0.5).abs() < 1e-9);
        assert!(found.converged);
    }

    #[test]
    fn a_direction_without_effect_does_no_harm() {
        let found = solve(&[0.9, 0.3], |z| vec![z[0] - 0.25]);
        assert!((found.z[0] - 0.25).abs() < 1e-6);
        assert_eq!(found.z[1], 0.3);
    }

    #[test]
    fn residuals_that_are_not_numbers_are_no_minimum() {
        assert!(!solve(&[0.5], |_| vec![f64::NAN]).converged);
        // At the start there is a value, beside it there is none.
        let edge = |z: &[f64]| vec![if z[0] == 0.5 { 1.0 } else { f64::NAN }];
        assert!(!solve(&[0.5], edge).converged);
    }

    #[test]
    fn a_failure_on_the_way_shortens_the_step() {
        let mut r = |z: &[f64]| {
            if z[0] > 0.8 {
                Err("lost")
            } else {
                Ok(vec![(z[0] - 0.79) * 100.0, 1.0])
            }
        };
        let found = minimise(&[0.0], &mut r).unwrap();
        assert!((found.z[0] - 0.79).abs() < 1e-6, "{found:?}");
        assert_eq!(minimise(&[0.9], &mut r).unwrap_err(), "lost");
    }
}
