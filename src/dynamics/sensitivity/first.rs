//! First derivatives of the base's motion and of the free accelerations.

use super::Sensitivity;
use super::directions::{Directions, in_sweep};
use crate::autodiff::{Dual, Kernel, dispatch};
use crate::dynamics::Storage;
use crate::dynamics::algebra::{Algebra, Coriolis, Force, Vector, plus_inner};

impl<Sp: Algebra, J: Storage, const N: usize, const FUSED: bool> Sensitivity<Sp, J, N, FUSED> {
    /// First derivatives in all directions, after [`Sensitivity::load`]. `omega_by` holds the
    /// derivatives of the base's angular velocity by the other directions, one after the other.
    pub fn first(&mut self, omega_by: &[f64]) {
        let angles = omega_by.chunks_exact(Sp::ANGLES);
        for (spun, angular) in self.spun.iter_mut().zip(angles) {
            spun.angular = Sp::Angular::from_components(angular);
            spun.linear = Sp::cross_constant(&spun.angular, &self.fixed.center).times(-1.0);
        }
        dispatch(First { of: self });
    }
}

struct First<'a, Sp: Algebra, J: Storage, const N: usize, const FUSED: bool> {
    of: &'a mut Sensitivity<Sp, J, N, FUSED>,
}

impl<Sp: Algebra, J: Storage, const N: usize, const FUSED: bool> Kernel
    for First<'_, Sp, J, N, FUSED>
{
    #[inline(always)]
    fn run(self) {
        self.of.carry();
        self.of.step();
        self.of.spread();
        for sweep in 0..self.of.tangents.len() {
            self.of.differentiate(sweep);
        }
    }
}

impl<Sp: Algebra, J: Storage, const N: usize, const FUSED: bool> Sensitivity<Sp, J, N, FUSED> {
    /// The motion of every body, and what those that each joint carries need for it.
    #[inline(always)]
    fn carry(&mut self) {
        let (fixed, carried) = (&self.fixed, &mut self.carried);
        fixed.motions(self.velocity, &self.rates, &mut carried.velocity);
        for (j, body) in fixed.bodies.iter().enumerate() {
            let axis = &fixed.axes[j];
            let velocity = &carried.velocity[j];
            let mut acceleration = fixed.carrier(j, &carried.acceleration, self.acceleration);
            acceleration.add_times(&axis.cross(velocity), -self.rates[j]);
            acceleration.add_times(axis, self.accelerations[j]);
            let at_center = body.center_velocity(velocity);
            let momentum = body.momentum(velocity, &at_center);
            carried.force[j] = body.force(velocity, &at_center, &acceleration);
            carried.coriolis[j] = body.coriolis(&velocity.angular, &momentum.linear);
            carried.momentum[j] = momentum;
            carried.acceleration[j] = acceleration;
        }
        let own = &fixed.base;
        let momentum = own.center_velocity(&self.velocity).times(own.mass);
        carried.whole = own.coriolis(&self.velocity.angular, &momentum);
        // What reaches the base of these two is of no use.
        let mut forgotten = Force::zero();
        fixed.gather(&mut carried.force, &mut forgotten, Force::add);
        fixed.gather(&mut carried.momentum, &mut forgotten, Force::add);
        fixed.gather(&mut carried.coriolis, &mut carried.whole, Coriolis::add);
    }

    /// What each joint changes in the bodies that it carries.
    #[inline(always)]
    fn step(&mut self) {
        let (fixed, carried) = (&self.fixed, &self.carried);
        for (j, step) in self.steps.iter_mut().enumerate() {
            let axis = &fixed.axes[j];
            let (inertia, coriolis) = (&fixed.carried[j], &carried.coriolis[j]);
            let velocity = fixed.carrier(j, &carried.velocity, self.velocity);
            let acceleration = fixed.carrier(j, &carried.acceleration, self.acceleration);

            let across = velocity.cross(axis);
            let mut by_position = acceleration.cross(axis);
            by_position.add(&velocity.cross(&across));
            let mut by_rate = across;
            by_rate.add(&across);
            step.velocity = across;
            step.acceleration = [by_position, by_rate];

            let mut force = [inertia.momentum(&by_position), inertia.momentum(&by_rate)];
            force[0].add(&coriolis.force(&across.angular));
            force[0].add(&axis.cross_force(&carried.force[j]));
            force[1].add(&coriolis.force(&axis.angular));
            step.force = force;

            let mut momentum = [inertia.momentum(&across), inertia.momentum(axis)];
            momentum[0].add(&axis.cross_force(&carried.momentum[j]));
            step.momentum = momentum;
            step.coriolis = coriolis.weight(axis);
        }
    }

    /// Writes what each joint changes in the momentum and the force of the whole and in the forces
    /// of the joints, with the motion of the base held.
    #[inline(always)]
    fn spread(&mut self) {
        let (fixed, n) = (&self.fixed, self.joints());
        let Directions {
            momentum,
            force,
            joints,
        } = &mut self.directions;
        for (j, own) in self.steps.iter().enumerate() {
            for (place, by) in [(j, 0), (n + j, 1)] {
                momentum.set(place, &own.momentum[by]);
                force.set(place, &own.force[by]);
            }
            for k in fixed.path(j) {
                let (inner, axis) = (&self.steps[k], &fixed.axes[k]);
                joints[k].0[j] = own.force[0].dot(axis);
                joints[k].0[n + j] = own.force[1].dot(axis);
                if k != j {
                    let inertia = &own.momentum[1];
                    joints[j].0[k] = inertia.dot(&inner.acceleration[0])
                        + own.coriolis.dot(&inner.velocity.angular);
                    joints[j].0[n + k] =
                        inertia.dot(&inner.acceleration[1]) + own.coriolis.dot(&axis.angular);
                }
            }
        }
    }

    /// Derivatives in the directions of one sweep.
    #[inline(always)]
    fn differentiate(&mut self, sweep: usize) {
        let (start, n) = (sweep * N, self.joints());
        let (fixed, directions) = (&self.fixed, &self.directions);
        let tangent = &mut self.tangents[sweep];

        // What the momentum gains the base must give back.
        let momentum = directions.momentum.sweep(start);
        let mut base = fixed.settled(&momentum).derivatives(&self.velocity, -1.0);
        for (i, spun) in self.spun.iter().enumerate() {
            if let Some(place) = in_sweep::<N>(start, 2 * n + i) {
                base.add_derivative(place, spun);
            }
        }

        // Forces with all accelerations held.
        let mut along = self.velocity.constant_cross(&base);
        let mut total: Force<Sp, Dual<N, FUSED>> = directions.force.sweep(start);
        total.add(&fixed.whole.momentum(&along));
        total.add(&self.carried.whole.force(&base.angular));
        for (j, residual) in self.residual.iter_mut().enumerate() {
            let step = &self.steps[j];
            let held = directions.joints[j].sweep(start) + along.dot(&step.momentum[1]);
            let (turning, by) = (base.angular.components(), step.coriolis.components());
            *residual = plus_inner(held, turning, by) - total.dot(&fixed.drag[j]);
        }
        fixed.data.factors.solve_constant(&mut self.residual);

        let mut pushed = fixed.settled(&total);
        for (j, joint) in tangent.joints.iter_mut().enumerate() {
            *joint = -self.residual[j];
            joint.value = self.accelerations[j];
            pushed.add_constant_times(&fixed.drag[j], *joint);
        }
        along.add_times(&pushed, -1.0);
        tangent.velocity = base;
        tangent.acceleration = along;
    }
}
