//! Second derivatives of a weighted sum of the base's motion and the free accelerations.

use super::Sensitivity;
use super::workspace::in_sweep;
use crate::autodiff::{Dual, Kernel, Scalar, Times, dispatch};
use crate::dynamics::algebra::{Algebra, Force, Motion, Vector};

impl<Sp: Algebra, const N: usize, const FUSED: bool> Sensitivity<Sp, N, FUSED> {
    /// Second derivatives of Σ `accelerations`·q̈ + Σ `turning`·ω₀, after [`Sensitivity::first`].
    ///
    /// How ω₀ depends on the other directions is held straight; its curvature, weighted with
    /// [`Sensitivity::momentum_weight`], is for the caller to add.
    pub fn second(&mut self, accelerations: &[f64], turning: &[f64]) {
        let rates = &mut self.adjoint.rates;
        rates.copy_from_slice(accelerations);
        self.fixed.data.factors.solve(rates);
        rates.iter_mut().for_each(|rate| *rate = -*rate);
        self.hessian.fill(0.0);
        for sweep in 0..self.tangents.len() {
            dispatch(Second {
                of: self,
                turning,
                sweep,
            });
        }
    }

    /// Weight of the system's angular momentum (base axes) in the sum of [`Sensitivity::second`].
    pub fn momentum_weight(&self) -> impl Iterator<Item = f64> {
        let rigid = self.adjoint.rigid.first();
        rigid
            .into_iter()
            .flat_map(|rigid| rigid.angular.components().iter().map(|c| -c.value))
    }
}

/// Adds the values of `angle` to `sum`.
#[inline(always)]
fn add_values<Sp: Algebra, const N: usize, const FUSED: bool>(
    sum: &mut Sp::Angular<f64>,
    angle: &Sp::Angular<Dual<N, FUSED>>,
) {
    for (sum, c) in sum.components_mut().iter_mut().zip(angle.components()) {
        *sum += c.value;
    }
}

/// One sweep.
struct Second<'a, Sp: Algebra, const N: usize, const FUSED: bool> {
    of: &'a mut Sensitivity<Sp, N, FUSED>,
    turning: &'a [f64],
    sweep: usize,
}

impl<Sp: Algebra, const N: usize, const FUSED: bool> Kernel for Second<'_, Sp, N, FUSED> {
    #[inline(always)]
    fn run(self) {
        let Self { of, turning, sweep } = self;
        let start = sweep * N;
        let n = of.joints;
        let place = |direction: usize| in_sweep::<N>(start, direction);
        let base_velocity = of.tangents[sweep].velocity;
        let base_acceleration = of.tangents[sweep].acceleration;
        let base_virtual = of.fixed.base_motion(&of.adjoint.rates).lifted();

        // Outwards: motions, and what each body makes of them.
        of.velocities(start, &base_velocity);
        let mut couple = Sp::Angular::<f64>::zero();
        for j in 0..n {
            let across = of.fixed.axes[j].constant_cross(&of.passes.velocity[j]);
            of.acceleration(start, j, &base_acceleration, &across);
            let body = &of.fixed.bodies[j];
            let axis = &of.fixed.axes[j];
            let acceleration = &mut of.passes.acceleration[j];
            acceleration.add_constant_times(axis, of.tangents[sweep].joints[j]);
            let adjoint = &mut of.adjoint;
            let motion = of
                .fixed
                .carried(j, &mut adjoint.virtual_motion, &base_virtual);
            motion.add_derivative(place(j), &axis.constant_cross(&motion.value()), -1.0);
            motion.add_value(axis, adjoint.rates[j]);
            let velocity = &of.passes.velocity[j];
            let at_center = body.center_velocity(velocity);
            let beside = body.center_velocity(motion);
            let weight = body.couple((velocity, &at_center), (motion, &beside));
            add_values::<Sp, N, FUSED>(&mut couple, &weight);
            of.passes.force[j] = body.force(velocity, &at_center, acceleration);
            adjoint.momentum[j] = body.momentum(velocity, &at_center);
            adjoint.virtual_momentum[j] = body.momentum(motion, &beside);
            adjoint.weight[j] = Force::new(weight, Sp::Linear::zero());
            adjoint.across[j] = across;
        }
        let own = &of.fixed.base;
        let beside = own.center_velocity(&base_virtual);
        let own_weight = own.couple(
            (&base_velocity, &own.center_velocity(&base_velocity)),
            (&base_virtual, &beside),
        );
        add_values::<Sp, N, FUSED>(&mut couple, &own_weight);
        let mut virtual_momentum = own.momentum(&base_virtual, &beside);

        // The motion, rigid about the mass centre, whose momentum weighs against all of that.
        for (sum, weight) in couple.components_mut().iter_mut().zip(turning) {
            *sum += weight;
        }
        let angular = Sp::apply_constant(&of.fixed.inverse_inertia, &couple).times(-1.0);
        let linear = Sp::cross_constant(&angular, &of.fixed.center).times(-1.0);
        let rigid: Motion<Sp, Dual<N, FUSED>> = Motion::new(angular, linear).lifted();
        for j in 0..n {
            let motion = of.fixed.carried(j, &mut of.adjoint.rigid, &rigid);
            let carried_along = of.fixed.axes[j].constant_cross(&motion.value());
            motion.add_derivative(place(j), &carried_along, -1.0);
        }

        // Inwards: the gradient.
        let mut weight = own.momentum(&rigid, &own.center_velocity(&rigid));
        weight.angular = weight.angular.plus(&own_weight);
        for j in (0..n).rev() {
            let adjoint = &mut of.adjoint;
            let axis = &of.fixed.axes[j];
            let body = &of.fixed.bodies[j];
            let rigid = &adjoint.rigid[j];
            // Until now the weight holds this body's couple and what its children handed on.
            let rigid_momentum = body.momentum(rigid, &body.center_velocity(rigid));
            adjoint.weight[j].add(&rigid_momentum);
            let (force, momentum) = (&of.passes.force[j], &adjoint.momentum[j]);
            let (weighs, beside) = (&adjoint.weight[j], &adjoint.virtual_momentum[j]);
            let across = &adjoint.across[j];

            let mut pulled = axis.constant_cross(&of.passes.acceleration[j]);
            pulled.add_times(&across.cross(&of.passes.velocity[j]), -1.0);
            let by_position = axis.constant_cross(&adjoint.virtual_motion[j]).dot(force)
                + across.dot(weighs)
                + pulled.dot(beside)
                + axis.constant_cross(rigid).dot(momentum);
            adjoint.direct[j] = -by_position;
            let by_rate = weighs.dot(axis);
            adjoint.direct[n + j] = by_rate.plus_times(across.dot(beside), -2.0);
            let joint = adjoint.implied.len() - n + j;
            adjoint.implied[joint] = beside.dot(axis);

            let fixed = &of.fixed;
            // What of these two reaches the base is of no use.
            let mut forgotten = Force::zero();
            fixed.hand_on(start, j, &mut of.passes.force, &mut forgotten);
            fixed.hand_on(start, j, &mut adjoint.momentum, &mut forgotten);
            fixed.hand_on(start, j, &mut adjoint.weight, &mut weight);
            fixed.hand_on(
                start,
                j,
                &mut adjoint.virtual_momentum,
                &mut virtual_momentum,
            );
        }
        weight.add_times(&base_velocity.cross_force(&virtual_momentum), -1.0);
        let implied = weight.iter().chain(virtual_momentum.iter());
        for (to, &from) in of.adjoint.implied.iter_mut().zip(implied) {
            *to = from;
        }
        of.gather(start);
    }
}

impl<Sp: Algebra, const N: usize, const FUSED: bool> Sensitivity<Sp, N, FUSED> {
    /// Columns `start`.. of the lower triangle: the gradient's own derivatives, and those by what
    /// the directions imply.
    #[inline(always)]
    fn gather(&mut self, start: usize) {
        let width = self.tangents.len() * N;
        for row in start..self.directions() {
            let tangent = &self.tangents[row / N];
            let place = row % N;
            let mut sums = match self.adjoint.direct.get(row) {
                Some(direct) => *direct,
                None => Dual::constant(0.0),
            };
            let implied = tangent.velocity.iter().chain(tangent.acceleration.iter());
            for (by, &along) in self
                .adjoint
                .implied
                .iter()
                .zip(implied.chain(&tangent.joints))
            {
                sums = sums.plus_times(*by, along.gradient[place]);
            }
            self.hessian[row * width + start..][..N].copy_from_slice(&sums.gradient);
        }
    }
}
