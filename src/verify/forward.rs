//! Open-loop re-integration of the unreduced equations of motion (4) under the planned control.

use super::Verification;
use super::bodies::{BaseMotion, Bodies};
use super::mass_matrix::{BASE, MassMatrix, NotPositiveDefinite};
use super::pass::{Pass, Planned};
use super::polynomial::Polynomial;
use super::quaternion::{turn_rate, unit, vector, write};
use crate::integrate::Ode;
use crate::numeric::raise_or_nan;
use crate::transcription::Discretization;

/// Base position, orientation, velocity, angular velocity and the joints' work; then θ and θ̇.
const POSITION: usize = 0;
const ORIENTATION: usize = 3;
const VELOCITY: usize = 7;
const WORK: usize = 13;
const JOINTS: usize = 14;

pub(super) struct Forward<'a> {
    planned: Planned<'a>,
    bodies: Bodies,
    mass: MassMatrix,
    control: Polynomial,
    /// Seconds a unit of τ in the current segment.
    unit: f64,
    u: Vec<f64>,
    torque: Vec<f64>,
    acceleration: Vec<f64>,
    start_energy: f64,
}

impl<'a> Forward<'a> {
    pub fn new(planned: Planned<'a>) -> Self {
        let n = planned.model.joint_count();
        Self {
            bodies: Bodies::new(planned.model),
            mass: MassMatrix::new(planned.model),
            planned,
            control: Polynomial::default(),
            unit: 0.0,
            u: vec![0.0; n],
            torque: vec![0.0; n],
            acceleration: vec![0.0; BASE + n],
            start_energy: 0.0,
        }
    }

    fn place_bodies(&mut self, y: &[f64]) {
        let (q, dq) = y[JOINTS..].split_at(self.u.len());
        let base = BaseMotion {
            velocity: vector(y, VELOCITY),
            angular: vector(y, VELOCITY + 3),
            ..BaseMotion::placed(vector(y, POSITION), unit(&y[ORIENTATION..]))
        };
        self.bodies.update(self.planned.model, &base, q, dq);
    }
}

impl Ode for Forward<'_> {
    type Error = NotPositiveDefinite;

    fn rate(&mut self, tau: f64, y: &[f64], dy: &mut [f64]) -> Result<(), NotPositiveDefinite> {
        let n = self.u.len();
        self.place_bodies(y);
        let dq = &y[JOINTS + n..];
        self.mass.update(self.planned.model, &self.bodies, dq)?;
        self.control.at(tau, &mut self.u);
        self.mass.reduced_times(&self.u, &mut self.torque);
        self.mass
            .accelerations(&self.torque, &mut self.acceleration);

        dy[..3].copy_from_slice(&y[VELOCITY..VELOCITY + 3]);
        turn_rate(
            &vector(y, VELOCITY + 3),
            &y[ORIENTATION..],
            &mut dy[ORIENTATION..],
        );
        dy[VELOCITY..VELOCITY + BASE].copy_from_slice(&self.acceleration[..BASE]);
        dy[WORK] = self
            .torque
            .iter()
            .zip(dq)
            .map(|(torque, rate)| torque * rate)
            .sum();
        dy[JOINTS..JOINTS + n].copy_from_slice(dq);
        dy[JOINTS + n..].copy_from_slice(&self.acceleration[BASE..]);
        for rate in dy {
            *rate *= self.unit;
        }
        Ok(())
    }
}

impl Pass for Forward<'_> {
    const NAME: &'static str = "the full dynamics";

    fn at(&mut self, k: usize) -> Result<Vec<f64>, NotPositiveDefinite> {
        let n = self.u.len();
        let (orientation, position) = self.planned.base(k);
        let mut y = vec![0.0; JOINTS + 2 * n];
        y[..3].copy_from_slice(position.as_slice());
        write(&orientation, &mut y[ORIENTATION..]);
        y[JOINTS..].copy_from_slice(self.planned.joints(k));
        self.place_bodies(&y);
        let dq = &y[JOINTS + n..];
        self.mass.update(self.planned.model, &self.bodies, dq)?;
        let (velocity, angular) = self.planned.twist(&self.mass, &self.bodies, &position, dq);
        y[VELOCITY..VELOCITY + 3].copy_from_slice(velocity.as_slice());
        y[VELOCITY + 3..VELOCITY + BASE].copy_from_slice(angular.as_slice());
        self.place_bodies(&y);
        self.start_energy = self.bodies.kinetic_energy();
        Ok(y)
    }

    fn enter(&mut self, plan: &Discretization, s: usize) {
        let start = plan.mesh.start(s);
        let nodes = plan.mesh.rule(s).points();
        self.control
            .load(nodes, (start..start + nodes.len()).map(|k| plan.control(k)));
        self.unit = 0.5 * plan.mesh.width(s) * plan.duration;
    }

    fn after_step(&mut self, y: &[f64], found: &mut Verification) {
        self.place_bodies(y);
        let gap = self.bodies.kinetic_energy() - self.start_energy - y[WORK];
        raise_or_nan(
            &mut found.max_linear_momentum,
            (self.bodies.linear_momentum() - self.planned.linear).norm(),
        );
        raise_or_nan(
            &mut found.max_angular_momentum,
            (self.bodies.angular_momentum() - self.planned.angular).norm(),
        );
        raise_or_nan(&mut found.max_energy_gap, gap.abs());
        found.steps += 1;
    }

    fn at_node(&mut self, k: usize, y: &[f64], found: &mut Verification) {
        let (orientation, position) = self.planned.base(k);
        let turned = unit(&y[ORIENTATION..]).angle_to(&orientation);
        raise_or_nan(&mut found.max_base_attitude_drift, turned);
        raise_or_nan(
            &mut found.max_base_position_drift,
            (vector(y, POSITION) - position).norm(),
        );
        let joints = y[JOINTS..].iter().zip(self.planned.joints(k));
        for (joint, (actual, planned)) in joints.take(self.u.len()).enumerate() {
            let drift = (actual - planned).abs();
            if drift > found.max_joint_drift {
                found.worst_joint = joint;
            }
            raise_or_nan(&mut found.max_joint_drift, drift);
        }
    }
}
