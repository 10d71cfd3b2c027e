//! Derivatives of the torques τ = Hu by the joint positions.
//!
//! Hu is the momentum of each joint in the motion of rates u that has no momentum as a whole, and
//! wᵀHu that of one such motion weighted with another: the same pass as for the accelerations,
//! without velocity products.

use super::Sensitivity;
use super::workspace::in_sweep;
use crate::autodiff::{Dual, Kernel, Times, dispatch};
use crate::dynamics::algebra::{Algebra, Force, Motion};

const CONTROLS: usize = 0;
const WEIGHTS: usize = 1;

impl<Sp: Algebra, const N: usize, const FUSED: bool> Sensitivity<Sp, N, FUSED> {
    /// ∂(Hu)/∂θ, n×n by rows, at fixed u; after [`Sensitivity::load`].
    pub fn torque_by(&mut self, u: &[f64], by: &mut [f64]) {
        for sweep in 0..self.joints.div_ceil(N) {
            dispatch(First {
                of: self,
                rates: u,
                which: CONTROLS,
                sweep,
                by,
            });
        }
    }

    /// ∂(Hw)/∂θ and, into the lower triangle of `second`, ∂²(wᵀHu)/∂θ²; n×n by rows. After
    /// [`Sensitivity::torque_by`] for the same u.
    pub fn torque_curvature(&mut self, u: &[f64], w: &[f64], by: &mut [f64], second: &mut [f64]) {
        for sweep in 0..self.joints.div_ceil(N) {
            dispatch(First {
                of: self,
                rates: w,
                which: WEIGHTS,
                sweep,
                by,
            });
            dispatch(Second {
                of: self,
                u,
                w,
                sweep,
                second,
            });
        }
    }

    /// The motion of the given joint rates on that of the base, and all momenta summed inwards.
    #[inline(always)]
    fn field(
        &mut self,
        start: usize,
        which: usize,
        base: &Motion<Sp, Dual<N, FUSED>>,
        rates: &[f64],
    ) -> Force<Sp, Dual<N, FUSED>> {
        let fixed = &self.fixed;
        let motions = &mut self.torque.motion[which];
        let momenta = &mut self.torque.momentum[which];
        for (j, body) in fixed.bodies.iter().enumerate() {
            let motion = fixed.carried(j, motions, base);
            let carried_along = fixed.axes[j].constant_cross(&motion.value());
            motion.add_derivative(in_sweep::<N>(start, j), &carried_along, -1.0);
            motion.add_value(&fixed.axes[j], rates[j]);
            momenta[j] = body.momentum(motion, &body.center_velocity(motion));
        }
        let mut total = fixed.base.momentum(base, &fixed.base.center_velocity(base));
        for j in (0..momenta.len()).rev() {
            fixed.hand_on(start, j, momenta, &mut total);
        }
        total
    }
}

/// One sweep of first derivatives.
struct First<'a, Sp: Algebra, const N: usize, const FUSED: bool> {
    of: &'a mut Sensitivity<Sp, N, FUSED>,
    rates: &'a [f64],
    which: usize,
    sweep: usize,
    by: &'a mut [f64],
}

impl<Sp: Algebra, const N: usize, const FUSED: bool> Kernel for First<'_, Sp, N, FUSED> {
    #[inline(always)]
    fn run(self) {
        let Self { of, which, .. } = self;
        let (start, n) = (self.sweep * N, of.joints);
        let still = of.fixed.base_motion(self.rates);
        let total = of.field(start, which, &still.lifted(), self.rates);
        let width = N.min(n - start);
        for j in 0..n {
            let along = of.torque.momentum[which][j].dot(&of.fixed.axes[j]);
            let torque = along - total.dot(&of.fixed.drag[j]);
            self.by[j * n + start..][..width].copy_from_slice(&torque.gradient[..width]);
        }
        if which == CONTROLS {
            of.torque.base[self.sweep] = of.fixed.settled(&total).derivatives(&still, -1.0);
        }
    }
}

/// One sweep of second derivatives.
struct Second<'a, Sp: Algebra, const N: usize, const FUSED: bool> {
    of: &'a mut Sensitivity<Sp, N, FUSED>,
    u: &'a [f64],
    w: &'a [f64],
    sweep: usize,
    second: &'a mut [f64],
}

impl<Sp: Algebra, const N: usize, const FUSED: bool> Kernel for Second<'_, Sp, N, FUSED> {
    #[inline(always)]
    fn run(self) {
        let Self { of, u, w, .. } = self;
        let (start, n) = (self.sweep * N, of.joints);
        let base = of.torque.base[self.sweep];
        of.field(start, CONTROLS, &base, u);
        let still = of.fixed.base_motion(w).lifted();
        let total = of.field(start, WEIGHTS, &still, w);
        let fields = &mut of.torque;
        for j in 0..n {
            let axis = &of.fixed.axes[j];
            let controls = axis.constant_cross(&fields.motion[CONTROLS][j]);
            let weights = axis.constant_cross(&fields.motion[WEIGHTS][j]);
            let sum = controls.dot(&fields.momentum[WEIGHTS][j])
                + weights.dot(&fields.momentum[CONTROLS][j]);
            fields.row[j] = -sum;
        }
        let width = N.min(n - start);
        for row in start..n {
            let mut sums = fields.row[row];
            let along = fields.base[row / N].iter();
            for (&by, along) in total.iter().zip(along) {
                sums = sums.plus_times(by, along.gradient[row % N]);
            }
            self.second[row * n + start..][..width].copy_from_slice(&sums.gradient[..width]);
        }
    }
}
