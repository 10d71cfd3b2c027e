//! What moves: the robot on its free base, with the momentum that it started with.

use super::drift::Drift;
use crate::autodiff::Scalar;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::{Space, Vector};
use crate::dynamics::{Data, Tree};
use crate::problem::Problem;

/// Parameters of a quaternion, of which no description of the attitude has more.
const MOST_PARAMETERS: usize = 4;

/// The dynamics behind the problem; immutable.
#[derive(Debug, Clone)]
pub(crate) struct Plant<Sp: Space> {
    pub tree: Tree<Sp>,
    pub attitude: Sp::Attitude,
    pub drift: Drift<Sp>,
    /// η(t₀).
    pub start_attitude: Vec<f64>,
    /// Whether base axes and inertial axes differ at t₀.
    pub starts_turned: bool,
    /// ζ(t₀), m.
    pub start_position: Sp::Linear<f64>,
    /// How fast the base turns at t₀ with the momentum it has and its joints at rest, rad/s.
    pub tumble_rate: f64,
}

impl<Sp: Space> Plant<Sp> {
    pub fn new(problem: &Problem, tree: Tree<Sp>, attitude: Sp::Attitude) -> Self {
        let mut data = Data::<Sp, f64>::new(&tree);
        tree.kinematics(&problem.task.initial_joints, &mut data);
        tree.momentum(&mut data);
        let start_attitude = attitude.of_angles(&problem.task.initial_base_attitude);
        let drift = Drift::new(&problem.task.initial_momentum, tree.total_mass());
        tree.base_rate(&vec![0.0; tree.joint_count()], &mut data);
        drift.tumble(attitude, &start_attitude, &mut data);
        Self {
            start_position: attitude.base_position(&start_attitude, &data.system_center),
            start_attitude,
            starts_turned: problem.task.starts_turned(),
            tumble_rate: data.base_rate.dot(&data.base_rate).sqrt(),
            drift,
            attitude,
            tree,
        }
    }

    /// Number of joints n.
    pub fn joints(&self) -> usize {
        self.tree.joint_count()
    }

    /// Number of attitude parameters.
    pub fn parameters(&self) -> usize {
        self.attitude.count()
    }

    /// Number of states: η, θ, θ̇.
    pub fn states(&self) -> usize {
        self.parameters() + 2 * self.joints()
    }

    /// The base's angular velocity for the joint rates and the system's momentum, into `data`;
    /// needs [`Tree::momentum`].
    pub fn base_rate<S: Scalar>(&self, eta: &[S], dtheta: &[S], data: &mut Data<Sp, S>) {
        self.tree.base_rate(dtheta, data);
        self.drift.tumble(self.attitude, eta, data);
    }

    /// ζ, `t` seconds after t₀, m; `center` is the system's mass centre in base axes.
    pub fn base_position<S: Scalar>(
        &self,
        eta: &[S],
        t: S,
        center: &Sp::Linear<S>,
    ) -> Sp::Linear<S> {
        let mut position = self.attitude.base_position(eta, center);
        self.drift.carry(t, position.components_mut());
        position
    }

    /// ζ − ζ(t₀), with the arguments of [`Plant::base_position`].
    pub fn base_displacement<S: Scalar>(
        &self,
        eta: &[S],
        t: S,
        center: &Sp::Linear<S>,
    ) -> Sp::Linear<S> {
        let mut moved = self.base_position(eta, t, center);
        let start = self.start_position.components();
        for (z, &z0) in moved.components_mut().iter_mut().zip(start) {
            *z -= z0;
        }
        moved
    }

    /// A vector in inertial axes by its components along the base axes at t₀.
    pub fn seen_from_start<S: Scalar>(&self, vector: &Sp::Linear<S>) -> Sp::Linear<S> {
        let mut eta = [S::constant(0.0); MOST_PARAMETERS];
        let eta = &mut eta[..self.parameters()];
        for (constant, &at) in eta.iter_mut().zip(&self.start_attitude) {
            *constant = S::constant(at);
        }
        Sp::along_axes(&self.attitude.orient(eta, &Sp::aligned()), vector)
    }

    /// The rates that limits and costs on the base are about: η̇ where η are angles, else ω₀.
    pub fn limited_rates<'a, S: Scalar>(
        &self,
        eta_rates: &'a [S],
        omega: &'a Sp::Angular<S>,
    ) -> &'a [S] {
        if self.attitude.is_angles() {
            eta_rates
        } else {
            omega.components()
        }
    }
}
