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
            let mut velocity = match self.fixed.parents[j] {
                Some(parent) => self.passes.velocity[parent],
                None => *base,
            };
            let turned = axis.across(&velocity.value());
            velocity.nudge(Self::lane(start, j), &turned, -1.0);
            velocity.shift(axis, self.rates[j]);
            velocity.nudge(Self::lane(start, self.joints + j), axis, 1.0);
            self.passes.velocity[j] = velocity;
        }
    }

    /// Sums `force` inwards; returns what reaches the base.
    #[inline(always)]
    pub(super) fn inwards(&mut self, start: usize) -> Screw<Sp, Dual<N, FUSED>> {
        let mut total = Screw::zero();
        for j in (0..self.joints).rev() {
            let force = self.fixed.handed(start, j, self.passes.force[j]);
            match self.fixed.parents[j] {
                Some(parent) => self.passes.force[parent].add(&force),
                None => total.add(&force),
            }
        }
        total
    }

    /// Acceleration of body `j` from that of its carrier, but for that of its joint; `across` is
    /// axis × velocity.
    #[inline(always)]
    pub(super) fn carried(
        &self,
        start: usize,
        j: usize,
        mut acceleration: Screw<Sp, Dual<N, FUSED>>,
        across: &Screw<Sp, Dual<N, FUSED>>,
    ) -> Screw<Sp, Dual<N, FUSED>> {
        let turned = self.fixed.axes[j].across(&acceleration.value());
        acceleration.nudge(Self::lane(start, j), &turned, -1.0);
        acceleration.add_scaled(across, -self.rates[j]);
        let lane = Self::lane(start, self.joints + j);
        acceleration.nudge(lane, &across.value(), -1.0);
        acceleration
    }
}

impl<Sp: Space> Configuration<Sp> {
    /// A force on body `j` as its carrier sees it.
    #[inline(always)]
    pub(super) fn handed<const N: usize, const FUSED: bool>(
        &self,
        start: usize,
        j: usize,
        mut force: Screw<Sp, Dual<N, FUSED>>,
    ) -> Screw<Sp, Dual<N, FUSED>> {
        let lane = j.checked_sub(start).filter(|&lane| lane < N);
        if lane.is_some() {
            let turned = self.axes[j].across_force(&force.value());
            force.nudge(lane, &turned, 1.0);
        }
        force
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
        for (j, body) in of.fixed.bodies.iter().enumerate() {
            let velocity = of.passes.velocity[j];
            let across = of.fixed.axes[j].across(&velocity);
            let from = match of.fixed.parents[j] {
                Some(parent) => of.passes.acceleration[parent],
                None => held,
            };
            let mut acceleration = of.carried(start, j, from, &across);
            acceleration.shift(&of.fixed.axes[j], of.accelerations[j]);
            of.passes.acceleration[j] = acceleration;
            of.passes.force[j] = body.force(&velocity, &body.at_center(&velocity), &acceleration);
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
