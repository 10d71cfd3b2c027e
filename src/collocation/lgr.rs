//! Legendre-Gauss-Radau points, quadrature weights and differentiation matrix.
//!
//! Derived in docs/algorithms.md#lgr-rule.

use super::Barycentric;
use std::f64::consts::PI;

/// The Radau rule of one segment with N points.
///
/// Points are the roots of P_{N−1} + P_N, eq. (21), from τ = −1 inclusive to +1 exclusive. The
/// state polynomial (22) goes through them and through τ = +1, which is not collocated.
#[derive(Debug, Clone, PartialEq)]
pub struct Rule {
    points: Vec<f64>,
    weights: Vec<f64>,
    differentiation: Vec<f64>,
    state: Barycentric,
    control: Barycentric,
}

impl Rule {
    /// The rule with `n` ≥ 1 points.
    ///
    /// # Panics
    /// If `n` is zero; [`Mesh::new`](super::Mesh::new) refuses such a segment before.
    pub fn new(n: usize) -> Self {
        assert!(n > 0, "a Radau rule has at least one point");
        let points = points(n);
        let weights = points
            .iter()
            .enumerate()
            .map(|(i, &tau)| {
                let n2 = (n * n) as f64;
                if i == 0 {
                    2.0 / n2
                } else {
                    (1.0 - tau) / (n2 * legendre(n - 1, tau).0.powi(2))
                }
            })
            .collect();
        let mut nodes = points.clone();
        nodes.push(1.0);
        let state = Barycentric::new(nodes);
        let differentiation = (0..n).flat_map(|i| state.derivative_at_node(i)).collect();
        Self {
            control: Barycentric::new(points.clone()),
            points,
            weights,
            differentiation,
            state,
        }
    }

    /// Number of collocation points N.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Never: a rule has at least one point.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Collocation points in [−1, 1), ascending; length N.
    pub fn points(&self) -> &[f64] {
        &self.points
    }

    /// Quadrature weights, exact for polynomials of degree 2N − 2; length N, sum 2.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// State nodes: the points and +1; length N + 1.
    pub fn nodes(&self) -> &[f64] {
        self.state.nodes()
    }

    /// Row `i` of the differentiation matrix D of (24): derivatives of the N + 1 state basis
    /// polynomials at point i.
    pub fn differentiation(&self, i: usize) -> &[f64] {
        let width = self.points.len() + 1;
        &self.differentiation[i * width..(i + 1) * width]
    }

    /// Interpolation of states, through the N + 1 nodes.
    pub fn state(&self) -> &Barycentric {
        &self.state
    }

    /// Interpolation of controls, through the N points only.
    pub fn control(&self) -> &Barycentric {
        &self.control
    }
}

/// P_n and its derivative by the three-term recurrence.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut value) = (0.0, 1.0);
    let (mut d_previous, mut derivative) = (0.0, 0.0);
    for k in 0..n {
        let k = k as f64;
        let next = ((2.0 * k + 1.0) * x * value - k * previous) / (k + 1.0);
        let d_next = d_previous + (2.0 * k + 1.0) * value;
        (previous, value) = (value, next);
        (d_previous, derivative) = (derivative, d_next);
    }
    (value, derivative)
}

fn points(n: usize) -> Vec<f64> {
    let mut points = vec![-1.0];
    for i in 1..n {
        // Roots of the Jacobi-like polynomial lie close to this cosine grid; Newton on
        // (P_{n−1} + P_n)/(1 + τ) converges quadratically and cannot fall back to −1.
        let mut tau = -(2.0 * PI * i as f64 / (2.0 * n as f64 - 1.0)).cos();
        for _ in 0..50 {
            let (a, da) = legendre(n - 1, tau);
            let (b, db) = legendre(n, tau);
            let f = (a + b) / (1.0 + tau);
            let slope = ((da + db) - f) / (1.0 + tau);
            let step = f / slope;
            tau -= step;
            if step.abs() < 1e-15 {
                break;
            }
        }
        points.push(tau);
    }
    points
}
