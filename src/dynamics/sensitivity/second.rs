//! Second derivatives of a weighted sum of the base's motion and the free accelerations.

use super::Sensitivity;
use super::workspace::JointGradient;
use crate::autodiff::{Dual, Kernel, Scalar, Times, dispatch};
use crate::dynamics::Storage;
use crate::dynamics::algebra::{Algebra, AngularMap, Force, Motion, Vector, plus_inner};

impl<Sp: Algebra, J: Storage, const N: usize, const FUSED: bool> Sensitivity<Sp, J, N, FUSED> {
    /// Second derivatives of Σ `accelerations`·q̈ + Σ `turning`·ω₀, after [`Sensitivity::first`].
    ///
    /// How ω₀ depends on the other directions is held straight; its curvature, weighted with
    /// [`Sensitivity::momentum_weight`], is for the caller to add.
    pub fn second(&mut self, accelerations: &[f64], turning: &[f64]) {
        let rates = &mut self.adjoint.rates;
        rates.copy_from_slice(accelerations);
        self.fixed.data.factors.solve(rates);
        rates.iter_mut().for_each(|rate| *rate = -*rate);
        dispatch(Second { of: self, turning });
    }

    /// Weight of the system's angular momentum (base axes) in the sum of [`Sensitivity::second`].
    pub fn momentum_weight(&self) -> impl Iterator<Item = f64> {
        self.adjoint.rigid.angular.components().iter().map(|c| -c)
    }
}

struct Second<'a, Sp: Algebra, J: Storage, const N: usize, const FUSED: bool> {
    of: &'a mut Sensitivity<Sp, J, N, FUSED>,
    turning: &'a [f64],
}

impl<Sp: Algebra, J: Storage, const N: usize, const FUSED: bool> Kernel
    for Second<'_, Sp, J, N, FUSED>
{
    #[inline(always)]
    fn run(self) {
        let Self { of, turning } = self;
        let whole = of.weigh(turning);
        of.grade();
        of.contract(&whole);
        of.mirror();
        of.join();
    }
}

impl<Sp: Algebra, J: Storage, const N: usize, const FUSED: bool> Sensitivity<Sp, J, N, FUSED> {
    /// The virtual motion and what it makes of the bodies that each joint carries; returns the
    /// matrix of how two changes of the whole robot's velocity weigh together.
    #[inline(always)]
    fn weigh(&mut self, turning: &[f64]) -> AngularMap<Sp> {
        let (fixed, carried, adjoint) = (&self.fixed, &self.carried, &mut self.adjoint);
        let base = fixed.base_motion(&adjoint.rates);
        fixed.motions(base, &adjoint.rates, &mut adjoint.virtual_motion);

        let own = &fixed.base;
        let mut whole = own.curvature(&base, &own.center_velocity(&base));
        // Of what a joint carries, a change of the velocity weighs in the virtual motion of its
        // carrier, which is common to all those bodies, and in what further joints add.
        let mut couple = carried.whole.weight(&base);
        for (j, body) in fixed.bodies.iter().enumerate() {
            let motion = &adjoint.virtual_motion[j];
            let at_center = body.center_velocity(motion);
            adjoint.virtual_momentum[j] = body.momentum(motion, &at_center);
            adjoint.curvature[j] = body.curvature(motion, &at_center);
            adjoint.weight[j] = self.steps[j].coriolis.times(adjoint.rates[j]);
        }
        let mut forgotten = Force::zero();
        fixed.gather(&mut adjoint.virtual_momentum, &mut forgotten, Force::add);
        fixed.gather(&mut adjoint.curvature, &mut whole, AngularMap::add);
        fixed.gather(&mut adjoint.weight, &mut couple, |to, own| {
            *to = to.plus(own)
        });
        for (j, coriolis) in carried.coriolis.iter().enumerate() {
            let motion = fixed.carrier(j, &adjoint.virtual_motion, base);
            adjoint.weight[j] = adjoint.weight[j].plus(&coriolis.weight(&motion));
        }

        // The motion, rigid about the mass centre, whose momentum weighs against all of that.
        for (sum, weight) in couple.components_mut().iter_mut().zip(turning) {
            *sum += weight;
        }
        let angular = Sp::apply_constant(&fixed.inverse_inertia, &couple).times(-1.0);
        let linear = Sp::cross_constant(&angular, &fixed.center).times(-1.0);
        adjoint.rigid = Motion::new(angular, linear);
        whole
    }

    /// What each joint changes in the gradient.
    #[inline(always)]
    fn grade(&mut self) {
        let (fixed, adjoint) = (&self.fixed, &mut self.adjoint);
        for (j, gradient) in adjoint.gradient.iter_mut().enumerate() {
            let (axis, inertia) = (&fixed.axes[j], &fixed.carried[j]);
            let (step, coriolis) = (&self.steps[j], &self.carried.coriolis[j]);
            let (momentum, curvature) = (&adjoint.virtual_momentum[j], &adjoint.curvature[j]);
            let bent = |change: &Motion<Sp, f64>| {
                let linear = Sp::moment(&change.linear, &momentum.linear).times(2.0);
                curvature.apply(&change.angular).plus(&linear)
            };
            let virtual_motion = adjoint.virtual_motion[j].cross(axis);
            let rigid = adjoint.rigid.cross(axis);

            let mut acceleration = inertia.momentum(&virtual_motion);
            acceleration.add(&axis.cross_force(momentum));

            let mut weight = inertia.momentum(&adjoint.rigid);
            weight.angular = weight.angular.plus(&adjoint.weight[j]);
            let mut velocity = axis.cross_force(&weight);
            velocity.add(&inertia.momentum(&rigid));
            let angular = coriolis.weight(&virtual_motion).plus(&bent(&step.velocity));
            velocity.angular = velocity.angular.plus(&angular);

            *gradient = JointGradient {
                virtual_motion,
                rigid,
                acceleration,
                velocity,
                velocity_by_rate: bent(axis),
            };
        }
        for j in 0..fixed.axes.len() {
            let own = &adjoint.gradient[j];
            for k in fixed.path(j) {
                let inner = &adjoint.gradient[k].virtual_motion;
                adjoint.by_accelerations[k][j] = inner.dot(&self.steps[j].momentum[1]);
                adjoint.by_accelerations[j][k] = own.acceleration.dot(&fixed.axes[k]);
            }
        }
    }

    /// Half of what directions imply for base and accelerations: rows weigh, columns imply.
    #[inline(always)]
    fn contract(&mut self, whole: &AngularMap<Sp>) {
        let n = self.joints();
        let width = self.tangents.len() * N;
        for row in 0..self.directions() {
            // What the base's own change brings is counted from both sides.
            let mut along = Sp::Angular::<f64>::zero();
            let from = &self.tangents[row / N].velocity.angular;
            for (to, from) in along.components_mut().iter_mut().zip(from.components()) {
                *to = 0.5 * from.gradient[row % N];
            }
            let turned = whole.apply(&along);
            for (sweep, tangent) in self.tangents.iter().enumerate() {
                let (velocity, acceleration) = (&tangent.velocity, &tangent.acceleration);
                let mut sum: Dual<N, FUSED>;
                if row < n {
                    let own = &self.adjoint.gradient[row];
                    let mut weight = own.velocity;
                    weight.angular = weight.angular.plus(&turned);
                    sum = velocity.dot(&weight) + acceleration.dot(&own.acceleration);
                    let by = &self.adjoint.by_accelerations[row];
                    for (joint, &by) in tangent.joints.iter().zip(by.iter()) {
                        sum = Times::<f64>::plus_times(sum, *joint, by);
                    }
                } else {
                    let mut weight = turned;
                    if let Some(own) = self.adjoint.gradient.get(row - n) {
                        weight = weight.plus(&own.velocity_by_rate);
                    }
                    let turning = velocity.angular.components();
                    sum = plus_inner(Dual::constant(0.0), turning, weight.components());
                }
                self.hessian[row * width + sweep * N..][..N].copy_from_slice(&sum.gradient);
            }
        }
    }

    /// Adds the other half, in which columns weigh and rows imply.
    #[inline(always)]
    fn mirror(&mut self) {
        let width = self.tangents.len() * N;
        for row in 0..self.directions() {
            for column in 0..row {
                self.hessian[row * width + column] += self.hessian[column * width + row];
            }
            self.hessian[row * width + row] *= 2.0;
        }
    }

    /// Adds the second derivatives in the directions of two joints.
    #[inline(always)]
    fn join(&mut self) {
        let n = self.joints();
        let width = self.tangents.len() * N;
        let hessian = &mut self.hessian;
        for (j, outer) in self.adjoint.gradient.iter().enumerate() {
            let own = &self.steps[j];
            for k in self.fixed.path(j) {
                let (inner, axis) = (&self.adjoint.gradient[k], &self.fixed.axes[k]);
                let step = &self.steps[k];
                let (shifted, rigid) = (&inner.virtual_motion, &inner.rigid);
                let positions = shifted.dot(&own.force[0])
                    + rigid.dot(&own.momentum[0])
                    + step.acceleration[0].dot(&outer.acceleration)
                    + step.velocity.dot(&outer.velocity);
                let position_rate = shifted.dot(&own.force[1])
                    + rigid.dot(&own.momentum[1])
                    + step.velocity.angular.dot(&outer.velocity_by_rate);
                let rates = axis.angular.dot(&outer.velocity_by_rate);
                hessian[j * width + k] += positions;
                hessian[(n + j) * width + k] += position_rate;
                hessian[(n + j) * width + n + k] += rates;
                if k != j {
                    hessian[(n + k) * width + j] +=
                        step.acceleration[1].dot(&outer.acceleration) + axis.dot(&outer.velocity);
                }
            }
        }
    }
}
