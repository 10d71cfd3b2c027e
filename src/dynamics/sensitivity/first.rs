//! First derivatives of the base's motion and of the free accelerations.

use super::Sensitivity;
use super::workspace::in_sweep;
use crate::autodiff::{Dual, Kernel, dispatch};
use crate::dynamics::algebra::{Algebra, Force, Motion, Vector};

impl<Sp: Algebra, const N: usize, const FUSED: bool> Sensitivity<Sp, N, FUSED> {
    /// First derivatives in all directions, after [`Sensitivity::load`]. `omega_by` holds the
    /// derivatives of the base's angular velocity by the other directions, one after the other.
    pub fn first(&mut self, omega_by: &[f64]) {
        let angles = omega_by.chunks_exact(Sp::ANGLES);
        for (spun, angular) in self.spun.iter_mut().zip(angles) {
            spun.angular = Sp::Angular::from_components(angular);
            spun.linear = Sp::cross_constant(&spun.angular, &self.fixed.center).times(-1.0);
        }
        for sweep in 0..self.tangents.len() {
            dispatch(First { of: self, sweep });
        }
    }

    /// Motions of the bodies outwards from the base's.
    #[inline(always)]
    pub(super) fn velocities(&mut self, start: usize, base: &Motion<Sp, Dual<N, FUSED>>) {
        for j in 0..self.joints {
            let axis = &self.fixed.axes[j];
            let velocity = self.fixed.carried(j, &mut self.passes.velocity, base);
            let carried_along = axis.constant_cross(&velocity.value());
            velocity.add_derivative(in_sweep::<N>(start, j), &carried_along, -1.0);
            velocity.add_value(axis, self.rates[j]);
            velocity.add_derivative(in_sweep::<N>(start, self.joints + j), axis, 1.0);
        }
    }

    /// Sums `force` inwards; returns what reaches the base.
    #[inline(always)]
    pub(super) fn inwards(&mut self, start: usize) -> Force<Sp, Dual<N, FUSED>> {
        let mut total = Force::zero();
        for j in (0..self.joints).rev() {
            self.fixed
                .hand_on(start, j, &mut self.passes.force, &mut total);
        }
        total
    }

    /// Finds the acceleration of body `j`, but for that of its joint, from that of its carrier or,
    /// where it stands on the base, from `base`; `across` is axis × velocity.
    #[inline(always)]
    pub(super) fn acceleration(
        &mut self,
        start: usize,
        j: usize,
        base: &Motion<Sp, Dual<N, FUSED>>,
        across: &Motion<Sp, Dual<N, FUSED>>,
    ) {
        let acceleration = self.fixed.carried(j, &mut self.passes.acceleration, base);
        let carried_along = self.fixed.axes[j].constant_cross(&acceleration.value());
        acceleration.add_derivative(in_sweep::<N>(start, j), &carried_along, -1.0);
        acceleration.add_times(across, -self.rates[j]);
        let direction = in_sweep::<N>(start, self.joints + j);
        acceleration.add_derivative(direction, &across.value(), -1.0);
    }
}

/// One sweep.
struct First<'a, Sp: Algebra, const N: usize, const FUSED: bool> {
    of: &'a mut Sensitivity<Sp, N, FUSED>,
    sweep: usize,
}

impl<Sp: Algebra, const N: usize, const FUSED: bool> Kernel for First<'_, Sp, N, FUSED> {
    #[inline(always)]
    fn run(self) {
        let Self { of, sweep } = self;
        let start = sweep * N;
        let n = of.joints;

        // Momentum with the base's motion held: what the base must give back.
        let held = of.velocity.lifted();
        of.velocities(start, &held);
        for (j, body) in of.fixed.bodies.iter().enumerate() {
            let velocity = &of.passes.velocity[j];
            of.passes.force[j] = body.momentum(velocity, &body.center_velocity(velocity));
        }
        let momentum = of.inwards(start);
        let mut base = of.fixed.settled(&momentum).derivatives(&of.velocity, -1.0);
        for (i, spun) in of.spun.iter().enumerate() {
            base.add_derivative(in_sweep::<N>(start, 2 * n + i), spun, 1.0);
        }

        // Forces with all accelerations held.
        of.velocities(start, &base);
        let held = of.acceleration.lifted();
        for j in 0..n {
            let across = of.fixed.axes[j].constant_cross(&of.passes.velocity[j]);
            of.acceleration(start, j, &held, &across);
            let acceleration = &mut of.passes.acceleration[j];
            acceleration.add_value(&of.fixed.axes[j], of.accelerations[j]);
            let (body, velocity) = (&of.fixed.bodies[j], &of.passes.velocity[j]);
            of.passes.force[j] =
                body.force(velocity, &body.center_velocity(velocity), acceleration);
        }
        let mut total = of.inwards(start);
        let own = &of.fixed.base;
        total.add(&own.force(&base, &own.center_velocity(&base), &held));
        for j in 0..n {
            let held = of.passes.force[j].dot(&of.fixed.axes[j]);
            of.passes.residual[j] = held - total.dot(&of.fixed.drag[j]);
        }
        of.fixed
            .data
            .factors
            .solve_constant(&mut of.passes.residual);

        let mut pushed = of.fixed.settled(&total);
        let tangent = &mut of.tangents[sweep];
        for j in 0..n {
            tangent.joints[j] = -of.passes.residual[j];
            tangent.joints[j].value = of.accelerations[j];
            pushed.add_constant_times(&of.fixed.drag[j], tangent.joints[j]);
        }
        tangent.velocity = base;
        tangent.acceleration = pushed.derivatives(&of.acceleration, -1.0);
    }
}
