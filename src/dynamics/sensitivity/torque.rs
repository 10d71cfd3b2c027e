//! Derivatives of the torques τ = Hu by the joint positions.
//!
//! Hu is the momentum of each joint in the motion of rates u that has no momentum as a whole, and
//! wᵀHu that of one such motion weighted with another: as for the accelerations, without velocity
//! products.

use super::Sensitivity;
use super::configuration::Configuration;
use super::workspace::{Field, JointStep};
use crate::autodiff::{Kernel, dispatch};
use crate::dynamics::Storage;
use crate::dynamics::algebra::{Algebra, Force};

impl<Sp: Algebra, J: Storage, const N: usize, const FUSED: bool> Sensitivity<Sp, J, N, FUSED> {
    /// ∂(Hu)/∂θ, n×n by rows, at fixed u; after [`Sensitivity::first`].
    pub fn torque_by(&mut self, u: &[f64], by: &mut [f64]) {
        dispatch(First {
            fixed: &self.fixed,
            steps: &self.steps,
            field: &mut self.controls,
            rates: u,
            by,
        });
    }

    /// ∂(Hw)/∂θ and, into the lower triangle of `second`, ∂²(wᵀHu)/∂θ²; n×n by rows. After
    /// [`Sensitivity::torque_by`] for u.
    pub fn torque_curvature(&mut self, w: &[f64], by: &mut [f64], second: &mut [f64]) {
        dispatch(First {
            fixed: &self.fixed,
            steps: &self.steps,
            field: &mut self.weights,
            rates: w,
            by,
        });
        dispatch(Second {
            fixed: &self.fixed,
            controls: &self.controls,
            weights: &self.weights,
            second,
        });
    }
}

/// First derivatives.
struct First<'a, Sp: Algebra, J: Storage> {
    fixed: &'a Configuration<Sp, J>,
    steps: &'a [JointStep<Sp>],
    field: &'a mut Field<Sp, J>,
    rates: &'a [f64],
    by: &'a mut [f64],
}

impl<Sp: Algebra, J: Storage> Kernel for First<'_, Sp, J> {
    #[inline(always)]
    fn run(self) {
        let Self { fixed, field, .. } = self;
        let base = fixed.base_motion(self.rates);
        fixed.motions(base, self.rates, &mut field.motion);
        for (j, body) in fixed.bodies.iter().enumerate() {
            let motion = &field.motion[j];
            field.momentum[j] = body.momentum(motion, &body.center_velocity(motion));
        }
        // Of all bodies and the base there is none.
        let mut forgotten = Force::zero();
        fixed.gather(&mut field.momentum, &mut forgotten, Force::add);
        let n = fixed.axes.len();
        for k in 0..n {
            let axis = &fixed.axes[k];
            let motion = field.motion[k].cross(axis);
            let mut momentum = fixed.carried[k].momentum(&motion);
            momentum.add(&axis.cross_force(&field.momentum[k]));
            for (j, drag) in fixed.drag.iter().enumerate() {
                self.by[j * n + k] = -momentum.dot(drag);
            }
            field.motion_by[k] = motion;
            field.momentum_by[k] = momentum;
        }
        for j in 0..n {
            for k in fixed.path(j) {
                self.by[k * n + j] += field.momentum_by[j].dot(&fixed.axes[k]);
                if k != j {
                    self.by[j * n + k] += field.motion_by[k].dot(&self.steps[j].momentum[1]);
                }
            }
        }
    }
}

/// Second derivatives.
struct Second<'a, Sp: Algebra, J: Storage> {
    fixed: &'a Configuration<Sp, J>,
    controls: &'a Field<Sp, J>,
    weights: &'a Field<Sp, J>,
    second: &'a mut [f64],
}

impl<Sp: Algebra, J: Storage> Kernel for Second<'_, Sp, J> {
    #[inline(always)]
    fn run(self) {
        let Self {
            fixed,
            controls,
            weights,
            second,
        } = self;
        let n = fixed.axes.len();
        // The base gives back what a joint changes in the momentum of the controls' motion, and
        // that weighs as any other motion does.
        for j in 0..n {
            let base = fixed.settled(&controls.momentum_by[j]);
            for k in 0..n {
                second[j * n + k] = -base.dot(&weights.momentum_by[k]);
            }
        }
        for j in 0..n {
            for k in 0..j {
                second[j * n + k] += second[k * n + j];
            }
            second[j * n + j] *= 2.0;
            for k in fixed.path(j) {
                second[j * n + k] += weights.motion_by[k].dot(&controls.momentum_by[j])
                    + controls.motion_by[k].dot(&weights.momentum_by[j]);
            }
        }
    }
}
