//! Barycentric Lagrange interpolation.
//!
//! Derived in docs/algorithms.md#barycentric-interpolation.

/// Lagrange interpolation through fixed nodes in barycentric form.
///
/// J.-P. Berrut and L. N. Trefethen, "Barycentric Lagrange interpolation",
/// doi:10.1137/S0036144502417715. Stable for any degree on clustered nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Barycentric {
    nodes: Vec<f64>,
    weights: Vec<f64>,
}

impl Barycentric {
    /// Interpolation through `nodes`, which must be distinct.
    pub fn new(nodes: Vec<f64>) -> Self {
        // Factors of 2 keep the products near one: the capacity of [−1, 1] is 1/2.
        let weights = nodes
            .iter()
            .enumerate()
            .map(|(j, &a)| {
                let others = nodes.iter().enumerate().filter(|&(k, _)| k != j);
                1.0 / others.map(|(_, &b)| 2.0 * (a - b)).product::<f64>()
            })
            .collect();
        Self { nodes, weights }
    }

    /// The nodes, ascending as given.
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// Values of the Lagrange basis polynomials L_j(τ), one a node.
    pub fn basis(&self, tau: f64) -> Vec<f64> {
        if let Some(hit) = self.nodes.iter().position(|&node| node == tau) {
            return (0..self.nodes.len()).map(|j| f64::from(j == hit)).collect();
        }
        let terms: Vec<f64> = self
            .nodes
            .iter()
            .zip(&self.weights)
            .map(|(node, w)| w / (tau - node))
            .collect();
        let sum: f64 = terms.iter().sum();
        terms.into_iter().map(|term| term / sum).collect()
    }

    /// Row i of the differentiation matrix: L̇_j at node i.
    ///
    /// The diagonal is minus the sum of the others, so that constants differentiate to exactly
    /// zero.
    pub fn derivative_at_node(&self, i: usize) -> Vec<f64> {
        let mut row: Vec<f64> = (0..self.nodes.len())
            .map(|j| {
                if i == j {
                    0.0
                } else {
                    self.weights[j] / self.weights[i] / (self.nodes[i] - self.nodes[j])
                }
            })
            .collect();
        row[i] = -row.iter().sum::<f64>();
        row
    }

    /// Values of L̇_j(τ), one a node, for any τ.
    ///
    /// L̇_j is itself interpolated exactly by its values at the nodes, which avoids the
    /// cancellation of the closed form close to a node.
    pub fn derivative(&self, tau: f64) -> Vec<f64> {
        let mut derivative = vec![0.0; self.nodes.len()];
        for (i, l) in self
            .basis(tau)
            .into_iter()
            .enumerate()
            .filter(|(_, l)| *l != 0.0)
        {
            for (sum, d) in derivative.iter_mut().zip(self.derivative_at_node(i)) {
                *sum += l * d;
            }
        }
        derivative
    }
}
