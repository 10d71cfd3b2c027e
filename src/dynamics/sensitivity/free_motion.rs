//! The free motion and where its derivatives are kept.

use super::configuration::Configuration;
use super::workspace::{Adjoint, Passes, Tangent, TorqueFields};
use crate::autodiff::{Dual, Scalar};
use crate::dynamics::algebra::{Algebra, Force, Motion, Vector};
use crate::dynamics::{Data, Tree};

/// Free motion at one point with its derivatives, in directions z = [θ, θ̇, others]: allocated
/// once, overwritten at every point.
///
/// The others are quantities that turn the base by [`Sensitivity::first`]'s argument: attitude
/// parameters of a system that tumbles. `N` directions go in one sweep.
#[derive(Debug)]
pub struct Sensitivity<Sp: Algebra, const N: usize, const FUSED: bool> {
    pub(super) joints: usize,
    pub(super) others: usize,
    pub(super) fixed: Configuration<Sp>,
    /// Motion of the base and of the joints.
    pub(super) velocity: Motion<Sp, f64>,
    pub(super) acceleration: Motion<Sp, f64>,
    pub(super) rates: Vec<f64>,
    pub(super) accelerations: Vec<f64>,
    /// Change of the base's motion by each of the other directions.
    pub(super) spun: Vec<Motion<Sp, f64>>,
    /// First derivatives, by sweeps.
    pub(super) tangents: Vec<Tangent<Sp, N, FUSED>>,
    pub(super) passes: Passes<Sp, Dual<N, FUSED>>,
    pub(super) adjoint: Adjoint<Sp, Dual<N, FUSED>>,
    pub(super) torque: TorqueFields<Sp, Dual<N, FUSED>>,
    /// Second derivatives, by rows as wide as all sweeps.
    pub(super) hessian: Vec<f64>,
}

impl<Sp: Algebra, const N: usize, const FUSED: bool> Sensitivity<Sp, N, FUSED> {
    /// Room for the derivatives of `tree`, with `others` directions beyond θ and θ̇.
    pub fn new(tree: &Tree<Sp>, others: usize) -> Self {
        let n = tree.joint_count();
        let directions = 2 * n + others;
        let sweeps = directions.div_ceil(N);
        Self {
            joints: n,
            others,
            fixed: Configuration::new(tree),
            velocity: Motion::zero(),
            acceleration: Motion::zero(),
            rates: vec![0.0; n],
            accelerations: vec![0.0; n],
            spun: vec![Motion::zero(); others],
            tangents: (0..sweeps)
                .map(|_| Tangent {
                    velocity: Motion::zero(),
                    acceleration: Motion::zero(),
                    joints: vec![Dual::constant(0.0); n],
                })
                .collect(),
            passes: Passes {
                velocity: vec![Motion::zero(); n],
                acceleration: vec![Motion::zero(); n],
                force: vec![Force::zero(); n],
                residual: vec![Dual::constant(0.0); n],
            },
            adjoint: Adjoint::new(n),
            torque: TorqueFields::new(n, n.div_ceil(N)),
            hessian: vec![0.0; directions * sweeps * N],
        }
    }

    /// Number of directions.
    pub fn directions(&self) -> usize {
        2 * self.joints + self.others
    }

    /// The free motion at the joint positions `q` and rates `dq`; `spin` adds to the base's angular
    /// velocity what momentum does, as in the problem itself.
    pub fn load(
        &mut self,
        tree: &Tree<Sp>,
        q: &[f64],
        dq: &[f64],
        spin: impl FnOnce(&mut Data<Sp, f64>),
    ) {
        let fixed = &mut self.fixed;
        let data = &mut fixed.data;
        tree.kinematics(q, data);
        tree.momentum(data);
        tree.base_rate(dq, data);
        spin(data);
        tree.mass_matrix(data);
        tree.bias(dq, data);
        data.factors.factor(&data.mass_matrix);
        self.accelerations.copy_from_slice(&data.bias);
        data.factors.solve(&mut self.accelerations);
        self.accelerations.iter_mut().for_each(|a| *a = -*a);
        self.rates.copy_from_slice(dq);
        fixed.read(tree);

        let data = &fixed.data;
        let omega = data.base_rate;
        let mut momentum = Sp::Linear::<f64>::zero();
        for (linear, &rate) in data.linear.iter().zip(dq) {
            momentum = momentum.plus_times(linear, rate);
        }
        let at_origin = Sp::cross_constant(&omega, &fixed.center).times(-1.0);
        self.velocity = Motion::new(
            omega,
            at_origin.plus_times(&momentum, -1.0 / fixed.total_mass),
        );
        // The bias pass takes the base's origin as at rest and its acceleration as that of the
        // point of the base: free of forces once more, then as seen at the origin.
        let force = data.net_force;
        let moment = data.net_torque.plus(&Sp::moment(&fixed.center, &force));
        let mut acceleration = fixed.settled(&Force::new(moment, force));
        for (drag, &a) in fixed.drag.iter().zip(&self.accelerations) {
            acceleration.add_times(drag, a);
        }
        let centripetal = Sp::cross(&omega, &self.velocity.linear).times(-1.0);
        self.acceleration = Motion::new(
            acceleration.angular.times(-1.0),
            acceleration.linear.times(-1.0).plus(&centripetal),
        );
    }

    /// The dynamics at the point.
    pub fn data(&self) -> &Data<Sp, f64> {
        &self.fixed.data
    }

    /// Free joint accelerations −H⁻¹Cθ̇, rad/s² or m/s²; length n.
    pub fn accelerations(&self) -> &[f64] {
        &self.accelerations
    }

    /// Derivative of the acceleration of joint `j` in `direction`; after [`Sensitivity::first`].
    pub fn acceleration_by(&self, j: usize, direction: usize) -> f64 {
        self.tangents[direction / N].joints[j].gradient[direction % N]
    }

    /// Derivative of component `i` of the base's angular velocity in `direction`; after
    /// [`Sensitivity::first`].
    pub fn base_rate_by(&self, i: usize, direction: usize) -> f64 {
        self.tangents[direction / N].velocity.angular.components()[i].gradient[direction % N]
    }

    /// Second derivative in two directions, `row` ≥ `column`; after [`Sensitivity::second`].
    pub fn second_by(&self, row: usize, column: usize) -> f64 {
        self.hessian[row * self.tangents.len() * N + column]
    }
}
