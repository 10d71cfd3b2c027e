//! A segment's polynomials, evaluated without allocation.

/// Polynomials through rows of values at common nodes, in barycentric form.
#[derive(Debug, Default)]
pub(super) struct Polynomial {
    nodes: Vec<f64>,
    weights: Vec<f64>,
    /// One row a node.
    rows: Vec<f64>,
}

impl Polynomial {
    /// Takes up new nodes and rows, as many of each.
    pub fn load<'a>(&mut self, nodes: &[f64], rows: impl Iterator<Item = &'a [f64]>) {
        self.nodes.clear();
        self.nodes.extend_from_slice(nodes);
        self.weights.clear();
        for (j, a) in nodes.iter().enumerate() {
            // On [−1, 1], factors of 2 keep the product of many differences near one.
            let differences = nodes.iter().enumerate().filter(|&(k, _)| k != j);
            self.weights
                .push(1.0 / differences.map(|(_, b)| 2.0 * (a - b)).product::<f64>());
        }
        self.rows.clear();
        for row in rows {
            self.rows.extend_from_slice(row);
        }
    }

    /// Takes up the derivative of `other`, by its values at the same nodes.
    pub fn load_derivative(&mut self, other: &Self) {
        self.nodes.clone_from(&other.nodes);
        self.weights.clone_from(&other.weights);
        let count = other.nodes.len();
        let width = other.rows.len() / count;
        self.rows.clear();
        self.rows.resize(other.rows.len(), 0.0);
        for i in 0..count {
            for j in (0..count).filter(|&j| j != i) {
                let d = other.weights[j] / other.weights[i] / (other.nodes[i] - other.nodes[j]);
                for k in 0..width {
                    self.rows[i * width + k] +=
                        d * (other.rows[j * width + k] - other.rows[i * width + k]);
                }
            }
        }
    }

    /// Values at τ, as many as a row has.
    pub fn at(&self, tau: f64, out: &mut [f64]) {
        let rows = self.rows.chunks_exact(out.len());
        out.fill(0.0);
        let mut sum = 0.0;
        for ((node, weight), row) in self.nodes.iter().zip(&self.weights).zip(rows) {
            if tau == *node {
                out.copy_from_slice(row);
                return;
            }
            let term = weight / (tau - node);
            sum += term;
            for (value, at_node) in out.iter_mut().zip(row) {
                *value += term * at_node;
            }
        }
        for value in out {
            *value /= sum;
        }
    }
}
