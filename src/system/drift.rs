//! What a momentum that the system starts with and keeps does to the base: drift and tumble.

use crate::autodiff::Scalar;
use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::problem::Momentum;

/// What momentum does to the base.
#[derive(Debug, Clone)]
pub(crate) struct Drift<Sp: Space> {
    /// Velocity of the system's mass centre, m/s; `None` where it rests.
    velocity: Option<Sp::Linear<f64>>,
    angular: Option<Sp::Angular<f64>>,
}

impl<Sp: Space> Drift<Sp> {
    pub fn new(momentum: &Momentum, total_mass: f64) -> Self {
        let any = |values: &[f64]| values.iter().any(|v| *v != 0.0);
        Self {
            velocity: any(&momentum.linear).then(|| {
                Sp::Linear::<f64>::from_components(&momentum.linear).times(1.0 / total_mass)
            }),
            angular: any(&momentum.angular)
                .then(|| Sp::Angular::from_components(&momentum.angular)),
        }
    }

    /// Adds I₀⁻¹RᵀL to the base's angular velocity.
    pub fn tumble<S: Scalar>(&self, attitude: Sp::Attitude, eta: &[S], data: &mut Data<Sp, S>) {
        if let Some(angular) = &self.angular {
            let seen = attitude.to_base(eta, angular);
            data.base_rate += Sp::apply(&data.inverse_inertia, &seen);
        }
    }

    /// Angular momentum, inertial axes; `None` where there is none.
    pub fn angular(&self) -> Option<&Sp::Angular<f64>> {
        self.angular.as_ref()
    }

    /// Moves `position` with the system's mass centre, `t` seconds after t₀.
    pub fn carry<S: Scalar>(&self, t: S, position: &mut [S]) {
        let velocity = self.velocity.iter().flat_map(|v| v.components());
        for (value, &v) in position.iter_mut().zip(velocity) {
            *value += t * v;
        }
    }
}
