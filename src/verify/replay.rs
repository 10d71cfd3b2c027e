//! The base's motion where the joints follow the planned path exactly, as under a controller
//! that tracks them.

use super::Verification;
use super::bodies::{BaseMotion, Bodies};
use super::mass_matrix::NotPositiveDefinite;
use super::pass::{Pass, Planned};
use super::polynomial::Polynomial;
use super::quaternion::{turn_rate, unit, vector, write};
use crate::integrate::Ode;
use crate::numeric::raise_or_nan;
use crate::transcription::Discretization;

/// Integrates the base's position and orientation by the system's momentum along the polynomial θ(t).
///
/// The rates are those of that polynomial, which is what the joints then truly do; the planned
/// rates θ̇ agree with them at the collocation points only.
pub(super) struct Replay<'a> {
    planned: Planned<'a>,
    bodies: Bodies,
    path: Polynomial,
    slope: Polynomial,
    q: Vec<f64>,
    dq: Vec<f64>,
    /// Seconds a unit of τ in the current segment.
    unit: f64,
}

impl<'a> Replay<'a> {
    pub fn new(planned: Planned<'a>) -> Self {
        let n = planned.model.joint_count();
        Self {
            bodies: Bodies::new(planned.model),
            planned,
            path: Polynomial::default(),
            slope: Polynomial::default(),
            q: vec![0.0; n],
            dq: vec![0.0; n],
            unit: 0.0,
        }
    }
}

impl Ode for Replay<'_> {
    type Error = NotPositiveDefinite;

    fn rate(&mut self, tau: f64, y: &[f64], dy: &mut [f64]) -> Result<(), NotPositiveDefinite> {
        self.path.at(tau, &mut self.q);
        self.slope.at(tau, &mut self.dq);
        self.dq.iter_mut().for_each(|rate| *rate /= self.unit);
        // What the joints alone carry of the momentum; the base has to bring the rest, as a rigid body of all.
        let position = vector(y, 0);
        let base = BaseMotion::placed(position, unit(&y[3..]));
        let (planned, bodies) = (&self.planned, &mut self.bodies);
        bodies.update(planned.model, &base, &self.q, &self.dq);
        let spin = planned.angular - bodies.angular_momentum();
        let inertia = bodies.inertia().cholesky().ok_or(NotPositiveDefinite)?;
        let angular = inertia.solve(&spin);
        let velocity = (planned.linear - bodies.linear_momentum()) / planned.total_mass
            - angular.cross(&(bodies.center() - position));
        dy[..3].copy_from_slice(velocity.as_slice());
        turn_rate(&angular, &y[3..], &mut dy[3..]);
        dy.iter_mut().for_each(|rate| *rate *= self.unit);
        Ok(())
    }
}

impl Pass for Replay<'_> {
    const NAME: &'static str = "the base along the joint path";

    fn at(&mut self, k: usize) -> Result<Vec<f64>, NotPositiveDefinite> {
        let (orientation, position) = self.planned.base(k);
        let mut y = vec![0.0; 7];
        y[..3].copy_from_slice(position.as_slice());
        write(&orientation, &mut y[3..]);
        Ok(y)
    }

    fn enter(&mut self, plan: &Discretization, s: usize) {
        let start = plan.mesh.start(s);
        let nodes = plan.mesh.rule(s).nodes();
        let n = self.q.len();
        let planned = &self.planned;
        self.path.load(
            nodes,
            (start..start + nodes.len()).map(|k| &planned.joints(k)[..n]),
        );
        self.slope.load_derivative(&self.path);
        self.unit = 0.5 * plan.mesh.width(s) * plan.duration;
    }

    fn after_step(&mut self, _y: &[f64], _found: &mut Verification) {}

    fn at_node(&mut self, k: usize, y: &[f64], found: &mut Verification) {
        let (orientation, position) = self.planned.base(k);
        raise_or_nan(
            &mut found.replay_base_attitude_drift,
            unit(&y[3..]).angle_to(&orientation),
        );
        raise_or_nan(
            &mut found.replay_base_position_drift,
            (vector(y, 0) - position).norm(),
        );
    }
}
