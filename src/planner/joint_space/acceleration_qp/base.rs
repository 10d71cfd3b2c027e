//! Base, torques and controls as affine functions of the joint accelerations.

use crate::autodiff::{Dual, Scalar};
use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::system::FreeFloating;

/// η̈ = Ja + b, τ = Hu and u = a + H⁻¹Cθ̇ at one instant.
#[derive(Debug, Clone, Default)]
pub(super) struct Affine {
    /// Rows of J = ∂η̇/∂θ̇, one an angle.
    pub jacobian: Vec<Vec<f64>>,
    /// b, rad/s².
    pub drift: Vec<f64>,
    /// η̇, rad/s.
    pub base_rate: Vec<f64>,
    /// Rows of H.
    pub inertia: Vec<Vec<f64>>,
    /// H⁻¹Cθ̇.
    pub coriolis: Vec<f64>,
}

/// Evaluates [`Affine`] for one system.
pub(super) struct Instant<'a, Sp: Space> {
    system: &'a FreeFloating<Sp>,
    data: Data<Sp, f64>,
    dual: Data<Sp, Dual<1>>,
}

impl<'a, Sp: Space> Instant<'a, Sp> {
    pub fn new(system: &'a FreeFloating<Sp>) -> Self {
        Self {
            system,
            data: Data::new(system.tree()),
            dual: Data::new(system.tree()),
        }
    }

    /// At attitude `eta`, joint positions `q` and rates `dq`.
    pub fn at(&mut self, eta: &[f64], q: &[f64], dq: &[f64]) -> Affine {
        let n = q.len();
        let (tree, attitude) = (self.system.tree(), self.system.attitude());
        let data = &mut self.data;
        tree.kinematics(q, data);
        tree.momentum(data);
        // η̇ is linear in the joint rates once the system's own tumbling is left out.
        let mut jacobian = vec![vec![0.0; n]; eta.len()];
        let mut unit = vec![0.0; n];
        let mut column = vec![0.0; eta.len()];
        for j in 0..n {
            unit[j] = 1.0;
            tree.base_rate(&unit, data);
            unit[j] = 0.0;
            attitude.rates(eta, &data.base_rate, &mut column);
            for (row, value) in jacobian.iter_mut().zip(&column) {
                row[j] = *value;
            }
        }
        self.system.base_rate(eta, dq, data);
        let mut base_rate = vec![0.0; eta.len()];
        attitude.rates(eta, &data.base_rate, &mut base_rate);
        tree.mass_matrix(data);
        tree.bias(dq, data);
        data.factors.factor(&data.mass_matrix);
        let mut coriolis = data.bias.clone();
        data.factors.solve(&mut coriolis);
        let inertia = (0..n)
            .map(|i| {
                (0..n)
                    .map(|j| data.mass_matrix[i.max(j) * n + i.min(j)])
                    .collect()
            })
            .collect();
        let drift = self.drift(eta, q, dq, &base_rate);
        Affine {
            jacobian,
            drift,
            base_rate,
            inertia,
            coriolis,
        }
    }

    /// η̇ alone.
    pub fn base_rate(&mut self, eta: &[f64], q: &[f64], dq: &[f64]) -> Vec<f64> {
        self.system.tree().kinematics(q, &mut self.data);
        self.system.tree().momentum(&mut self.data);
        self.system.base_rate(eta, dq, &mut self.data);
        let mut rates = vec![0.0; eta.len()];
        self.system
            .attitude()
            .rates(eta, &self.data.base_rate, &mut rates);
        rates
    }

    /// dη̇/dt at constant joint rates.
    fn drift(&mut self, eta: &[f64], q: &[f64], dq: &[f64], deta: &[f64]) -> Vec<f64> {
        let moving = |values: &[f64], rates: &[f64]| -> Vec<Dual<1>> {
            let pairs = values.iter().zip(rates);
            pairs
                .map(|(&value, &rate)| Dual {
                    value,
                    gradient: [rate],
                })
                .collect()
        };
        let (eta, q) = (moving(eta, deta), moving(q, dq));
        let dq: Vec<Dual<1>> = dq.iter().map(|&rate| Dual::constant(rate)).collect();
        let tree = self.system.tree();
        tree.kinematics(&q, &mut self.dual);
        tree.momentum(&mut self.dual);
        self.system.base_rate(&eta, &dq, &mut self.dual);
        let mut rates = vec![Dual::constant(0.0); eta.len()];
        self.system
            .attitude()
            .rates(&eta, &self.dual.base_rate, &mut rates);
        rates.iter().map(|rate| rate.gradient[0]).collect()
    }
}
