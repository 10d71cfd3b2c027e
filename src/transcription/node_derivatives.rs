//! Values and derivatives of one collocation point, by dual numbers or by the problem's own code.

use crate::autodiff::Sparsity;
use crate::ocp::{
    Derivatives, DynOcp, Formulation, Functions, Part, PointDerivatives, PointShape, Shape,
};

/// Values, nonzeros of the Jacobian and of the weighted Hessian of a collocation point: what one
/// thread needs, allocated once.
pub(super) struct NodeDerivatives<'a> {
    shape: PointShape,
    sparsity: Sparsity,
    nonzeros: usize,
    plain: Box<dyn Functions + 'a>,
    evaluator: Evaluator<'a>,
}

/// How derivatives are computed.
enum Evaluator<'a> {
    /// By dual numbers, which sweep over the whole function.
    DualNumbers(Box<dyn Derivatives + 'a>),
    /// By the problem itself, [`Ocp::derivatives`](crate::ocp::Ocp::derivatives): dense, the nonzeros
    /// are picked from them.
    Analytic {
        derivatives: Box<dyn PointDerivatives + 'a>,
        dense: Vec<f64>,
        jacobian: Vec<usize>,
        hessian: Vec<usize>,
    },
}

impl<'a> NodeDerivatives<'a> {
    pub fn new(ocp: &'a dyn DynOcp, formulation: &Formulation, sparsity: Sparsity) -> Self {
        let shape = PointShape::of(formulation);
        let (inputs, outputs) = (shape.inputs(), shape.outputs());
        let evaluator = match ocp.own_derivatives() {
            None => Evaluator::DualNumbers(ocp.differentiate(
                Part::Point,
                formulation,
                sparsity.clone(),
            )),
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
            shape,
            nonzeros: sparsity.nonzeros(),
            plain: ocp.functions(),
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
    pub fn values(&mut self, v: &[f64], out: &mut [f64]) {
        let [rates, path, cost, integrands] = self.shape.split(out);
        let point = self.shape.point(v);
        cost[0] = self.plain.continuous(point, rates, path);
        if !integrands.is_empty() {
            self.plain.integrands(point, integrands);
        }
    }

    /// Nonzeros of the Jacobian at `v`, output by output.
    pub fn jacobian(&mut self, v: &[f64], out: &mut [f64]) {
        match &mut self.evaluator {
            Evaluator::DualNumbers(sparse) => sparse.jacobian(v, out),
            Evaluator::Analytic {
                derivatives,
                dense,
                jacobian,
                ..
            } => {
                let dense = &mut dense[..self.shape.outputs() * self.shape.inputs()];
                derivatives.jacobian(self.shape.point(v), dense);
                pick(dense, jacobian, out);
            }
        }
    }

    /// Nonzeros of Σ weightsᵢ ∇²fᵢ at `v`, in the order of [`Sparsity::hessian`].
    pub fn hessian(&mut self, v: &[f64], weights: &[f64], out: &mut [f64]) {
        match &mut self.evaluator {
            Evaluator::DualNumbers(sparse) => sparse.hessian(v, weights, out),
            Evaluator::Analytic {
                derivatives,
                dense,
                hessian,
                ..
            } => {
                let dense = &mut dense[..self.shape.inputs() * self.shape.inputs()];
                derivatives.hessian(self.shape.point(v), weights, dense);
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
