//! Derivatives of the torques τ = Hu by the joint positions.
//!
//! Hu is the momentum of each joint in the motion of rates u that has no momentum as a whole, and
//! wᵀHu that of one such motion weighted with another: the same pass as for the accelerations,
//! without velocity products.

use super::*;
use crate::autodiff::Kernel;

/// Momentum-free motions, of the controls and of the weights, and their momenta.
#[derive(Debug)]
pub(super) struct Fields<Sp: Space, S: Scalar> {
    motion: [Vec<Screw<Sp, S>>; 2],
    momentum: [Vec<Screw<Sp, S>>; 2],
    /// Change of the base's motion of the controls, by sweeps.
    base: Vec<Screw<Sp, S>>,
    row: Vec<S>,
}

impl<Sp: Space, S: Scalar> Fields<Sp, S> {
    pub fn new(n: usize, sweeps: usize) -> Self {
        let screws = || vec![Screw::zero(); n];
        Self {
            motion: [screws(), screws()],
            momentum: [screws(), screws()],
            base: vec![Screw::zero(); sweeps],
            row: vec![S::zero(); n],
        }
    }
}

const CONTROLS: usize = 0;
const WEIGHTS: usize = 1;

impl<Sp: Space, const N: usize, const FUSED: bool> Sensitivity<Sp, N, FUSED> {
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
        base: &Screw<Sp, Dual<N, FUSED>>,
        rates: &[f64],
    ) -> Screw<Sp, Dual<N, FUSED>> {
        let fixed = &self.fixed;
        let motions = &mut self.torque.motion[which];
        let momenta = &mut self.torque.momentum[which];
        for (j, body) in fixed.bodies.iter().enumerate() {
            let motion = fixed.carried(j, motions, base);
            let turned = fixed.axes[j].across(&motion.value());
            motion.nudge(Self::lane(start, j), &turned, -1.0);
            motion.shift(&fixed.axes[j], rates[j]);
            momenta[j] = body.momentum(motion, &body.at_center(motion));
        }
        let mut total = fixed.base.momentum(base, &fixed.base.at_center(base));
        for j in (0..momenta.len()).rev() {
            fixed.hand_on(start, j, momenta, &mut total);
        }
        total
    }
}

/// One sweep of first derivatives.
struct First<'a, Sp: Space, const N: usize, const FUSED: bool> {
    of: &'a mut Sensitivity<Sp, N, FUSED>,
    rates: &'a [f64],
    which: usize,
    sweep: usize,
    by: &'a mut [f64],
}

impl<Sp: Space, const N: usize, const FUSED: bool> Kernel for First<'_, Sp, N, FUSED> {
    #[inline(always)]
    fn run(self) {
        let Self { of, which, .. } = self;
        let (start, n) = (self.sweep * N, of.joints);
        let still = of.fixed.base_motion(self.rates);
        let total = of.field(start, which, &still.lifted(), self.rates);
        let lanes = N.min(n - start);
        for j in 0..n {
            let along = of.torque.momentum[which][j].dot(&of.fixed.axes[j]);
            let torque = along - total.dot(&of.fixed.drag[j]);
            self.by[j * n + start..][..lanes].copy_from_slice(&torque.gradient[..lanes]);
        }
        if which == CONTROLS {
            of.torque.base[self.sweep] = of.fixed.settled(&total).derivatives(&still, -1.0);
        }
    }
}

/// One sweep of second derivatives.
struct Second<'a, Sp: Space, const N: usize, const FUSED: bool> {
    of: &'a mut Sensitivity<Sp, N, FUSED>,
    u: &'a [f64],
    w: &'a [f64],
    sweep: usize,
    second: &'a mut [f64],
}

impl<Sp: Space, const N: usize, const FUSED: bool> Kernel for Second<'_, Sp, N, FUSED> {
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
            let controls = axis.across(&fields.motion[CONTROLS][j]);
            let weights = axis.across(&fields.motion[WEIGHTS][j]);
            let sum = controls.dot(&fields.momentum[WEIGHTS][j])
                + weights.dot(&fields.momentum[CONTROLS][j]);
            fields.row[j] = -sum;
        }
        let lanes = N.min(n - start);
        for row in start..n {
            let mut sums = fields.row[row];
            let along = fields.base[row / N].iter();
            for (&by, along) in total.iter().zip(along) {
                sums = sums.plus_multiple(by, along.gradient[row % N]);
            }
            self.second[row * n + start..][..lanes].copy_from_slice(&sums.gradient[..lanes]);
        }
    }
}
