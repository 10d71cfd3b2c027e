//! Values and derivatives of one collocation point, by dual numbers or by the problem's own code.

use super::functions::Node;
use crate::autodiff::{Function, SparseDerivatives, Sparsity};
use crate::ocp::{Ocp, PointDerivatives};

/// Values, nonzeros of the Jacobian and of the weighted Hessian of a [`Node`]: what one thread
/// needs, allocated once.
pub(super) struct NodeDerivatives<'a, O: Ocp> {
    sparsity: Sparsity,
    nonzeros: usize,
    plain: O::Scratch<f64>,
    evaluator: Evaluator<'a, O>,
}

/// How derivatives are computed.
enum Evaluator<'a, O: Ocp> {
    /// By dual numbers, which sweep over the whole function.
    DualNumbers(Box<SparseDerivatives<Node<'a, O>>>),
    /// By the problem itself, [`Ocp::derivatives`]: dense, the nonzeros are picked from them.
    Analytic {
        derivatives: Box<dyn PointDerivatives + 'a>,
        dense: Vec<f64>,
        jacobian: Vec<usize>,
        hessian: Vec<usize>,
    },
}

impl<'a, O: Ocp> NodeDerivatives<'a, O> {
    pub fn new(node: &Node<'a, O>, sparsity: Sparsity) -> Self {
        let (inputs, outputs) = (node.inputs(), node.outputs());
        let evaluator = match node.ocp.derivatives() {
            None => {
                Evaluator::DualNumbers(Box::new(SparseDerivatives::new(node, sparsity.clone())))
            }
            Some(derivatives) => Evaluator::Analytic {
                derivatives,
                dense: vec![0.0; inputs * inputs.max(outputs)],
                jacobian: (sparsity.jacobian.iter().enumerate())
                    .flat_map(|(row, columns)| columns.iter().map(move |c| row * inputs + c))
                    .collect(),
                hessian: sparsity
                    .hessian
                    .iter()
                    .map(|(i, j)| i * inputs + j)
                    .collect(),
            },
        };
        Self {
            nonzeros: sparsity.jacobian.iter().map(Vec::len).sum(),
            plain: node.ocp.scratch(),
            evaluator,
            sparsity,
        }
    }

    /// The nonzero pattern.
    pub fn sparsity(&self) -> &Sparsity {
        &self.sparsity
    }

    /// Number of nonzeros of the Jacobian.
    pub fn jacobian_nonzeros(&self) -> usize {
        self.nonzeros
    }

    /// How many numbers [`NodeDerivatives::keep`] writes.
    pub fn kept(&self) -> usize {
        match &self.evaluator {
            Evaluator::DualNumbers(_) => 0,
            Evaluator::Analytic { derivatives, .. } => derivatives.kept(),
        }
    }

    /// Keeps what the last evaluation has found out for another one at the same point.
    pub fn keep(&mut self, kept: &mut [f64]) {
        if let Evaluator::Analytic { derivatives, .. } = &mut self.evaluator {
            derivatives.keep(kept);
        }
    }

    /// Takes up what was kept.
    pub fn recall(&mut self, kept: &[f64]) {
        if let Evaluator::Analytic { derivatives, .. } = &mut self.evaluator {
            derivatives.recall(kept);
        }
    }

    /// Values at the inputs `v`, into `out`.
    pub fn values(&mut self, node: &Node<'a, O>, v: &[f64], out: &mut [f64]) {
        node.evaluate(v, &mut self.plain, out);
    }

    /// Nonzeros of the Jacobian at `v`, output by output.
    pub fn jacobian(&mut self, node: &Node<'a, O>, v: &[f64], out: &mut [f64]) {
        match &mut self.evaluator {
            Evaluator::DualNumbers(sparse) => sparse.jacobian(node, v, out),
            Evaluator::Analytic {
                derivatives,
                dense,
                jacobian,
                ..
            } => {
                let dense = &mut dense[..node.outputs() * node.inputs()];
                derivatives.jacobian(node.point(v), dense);
                pick(dense, jacobian, out);
            }
        }
    }

    /// Nonzeros of Σ weightsᵢ ∇²fᵢ at `v`, in the order of [`Sparsity::hessian`].
    pub fn hessian(&mut self, node: &Node<'a, O>, v: &[f64], weights: &[f64], out: &mut [f64]) {
        match &mut self.evaluator {
            Evaluator::DualNumbers(sparse) => sparse.hessian(node, v, weights, out),
            Evaluator::Analytic {
                derivatives,
                dense,
                hessian,
                ..
            } => {
                let dense = &mut dense[..node.inputs() * node.inputs()];
                derivatives.hessian(node.point(v), weights, dense);
                pick(dense, hessian, out);
            }
        }
    }
}

fn pick(dense: &[f64], from: &[usize], out: &mut [f64]) {
    for (to, &from) in out.iter_mut().zip(from) {
        *to = dense[from];
    }
}
