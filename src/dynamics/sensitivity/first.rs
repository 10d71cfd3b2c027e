//! First derivatives of the base's motion and of the free accelerations.

use super::*;
use crate::autodiff::Kernel;

impl<Sp: Space, const N: usize, const FUSED: bool> Sensitivity<Sp, N, FUSED> {
    /// First derivatives in all directions, after [`Sensitivity::load`]. `turned` holds the
    /// derivatives of the base's angular velocity by the other directions, one after the other.
    pub fn first(&mut self, turned: &[f64]) {
        let angles = turned.chunks_exact(Sp::ANGLES);
        for (spun, angular) in self.spun.iter_mut().zip(angles) {
            spun.angular = array(angular);
            spun.linear = scaled(Sp::carry(&spun.angular, &self.fixed.center), -1.0);
        }
        for sweep in 0..self.tangents.len() {
            dispatch(First { of: self, sweep });
        }
    }

    /// Motions of the bodies outwards from the base's.
    #[inline(always)]
    pub(super) fn velocities(&mut self, start: usize, base: &Screw<Sp, Dual<N, FUSED>>) {
        for j in 0..self.joints {
            let axis = &self.fixed.axes[j];
            let velocity = self.fixed.carried(j, &mut self.passes.velocity, base);
            let turned = axis.across(&velocity.value());
            velocity.nudge(Self::lane(start, j), &turned, -1.0);
            velocity.shift(axis, self.rates[j]);
            velocity.nudge(Self::lane(start, self.joints + j), axis, 1.0);
        }
    }

    /// Sums `force` inwards; returns what reaches the base.
    #[inline(always)]
    pub(super) fn inwards(&mut self, start: usize) -> Screw<Sp, Dual<N, FUSED>> {
        let mut total = Screw::zero();
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
        base: &Screw<Sp, Dual<N, FUSED>>,
        across: &Screw<Sp, Dual<N, FUSED>>,
    ) {
        let acceleration = self.fixed.carried(j, &mut self.passes.acceleration, base);
        let turned = self.fixed.axes[j].across(&acceleration.value());
        acceleration.nudge(Self::lane(start, j), &turned, -1.0);
        acceleration.add_scaled(across, -self.rates[j]);
        let lane = Self::lane(start, self.joints + j);
        acceleration.nudge(lane, &across.value(), -1.0);
    }
}

impl<Sp: Space> Configuration<Sp> {
    /// Gives body `j` the motion of its carrier or, where it stands on the base, `base`.
    #[inline(always)]
    pub(super) fn carried<'m, S: Scalar>(
        &self,
        j: usize,
        motions: &'m mut [Screw<Sp, S>],
        base: &Screw<Sp, S>,
    ) -> &'m mut Screw<Sp, S> {
        let (before, rest) = motions.split_at_mut(j);
        let from = match self.parents[j] {
            Some(parent) => &before[parent],
            None => base,
        };
        rest[0] = *from;
        &mut rest[0]
    }

    /// Adds the force on body `j`, as its carrier sees it, to that on the carrier or, where it
    /// stands on the base, to `base`.
    #[inline(always)]
    pub(super) fn hand_on<const N: usize, const FUSED: bool>(
        &self,
        start: usize,
        j: usize,
        forces: &mut [Screw<Sp, Dual<N, FUSED>>],
        base: &mut Screw<Sp, Dual<N, FUSED>>,
    ) {
        let (before, rest) = forces.split_at_mut(j);
        let force = &rest[0];
        let to = match self.parents[j] {
            Some(parent) => &mut before[parent],
            None => base,
        };
        to.add(force);
        let lane = j.checked_sub(start).filter(|&lane| lane < N);
        if lane.is_some() {
            to.nudge(lane, &self.axes[j].across_force(&force.value()), 1.0);
        }
    }
}

/// One sweep.
struct First<'a, Sp: Space, const N: usize, const FUSED: bool> {
    of: &'a mut Sensitivity<Sp, N, FUSED>,
    sweep: usize,
}

impl<Sp: Space, const N: usize, const FUSED: bool> Kernel for First<'_, Sp, N, FUSED> {
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
            of.passes.force[j] = body.momentum(velocity, &body.at_center(velocity));
        }
        let momentum = of.inwards(start);
        let mut base = of.fixed.settled(&momentum).derivatives(&of.velocity, -1.0);
        for (i, spun) in of.spun.iter().enumerate() {
            base.nudge(
                Sensitivity::<Sp, N, FUSED>::lane(start, 2 * n + i),
                spun,
                1.0,
            );
        }

        // Forces with all accelerations held.
        of.velocities(start, &base);
        let held = of.acceleration.lifted();
        for j in 0..n {
            let across = of.fixed.axes[j].across(&of.passes.velocity[j]);
            of.acceleration(start, j, &held, &across);
            let acceleration = &mut of.passes.acceleration[j];
            acceleration.shift(&of.fixed.axes[j], of.accelerations[j]);
            let (body, velocity) = (&of.fixed.bodies[j], &of.passes.velocity[j]);
            of.passes.force[j] = body.force(velocity, &body.at_center(velocity), acceleration);
        }
        let mut total = of.inwards(start);
        let own = &of.fixed.base;
        total.add(&own.force(&base, &own.at_center(&base), &held));
        for j in 0..n {
            let held = of.passes.force[j].dot(&of.fixed.axes[j]);
            of.passes.residual[j] = held - total.dot(&of.fixed.drag[j]);
        }
        of.fixed.data.factors.solve_over(&mut of.passes.residual);

        let mut pushed = of.fixed.settled(&total);
        let tangent = &mut of.tangents[sweep];
        for j in 0..n {
            tangent.joints[j] = -of.passes.residual[j];
            tangent.joints[j].value = of.accelerations[j];
            pushed.add_column(&of.fixed.drag[j], tangent.joints[j]);
        }
        tangent.velocity = base;
        tangent.acceleration = pushed.derivatives(&of.acceleration, -1.0);
    }
}
