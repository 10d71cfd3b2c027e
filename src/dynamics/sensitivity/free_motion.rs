//! The free motion and where its derivatives are kept.

use super::configuration::Configuration;
use super::directions::Directions;
use super::workspace::{Adjoint, Carried, Field, JointStep, Tangent};
use crate::autodiff::{Dual, Scalar};
use crate::dynamics::algebra::{Algebra, Force, Motion, Vector};
use crate::dynamics::{Data, Storage, Tree};

/// Free motion at one point with its derivatives, in directions z = [θ, θ̇, others]: allocated
/// once, overwritten at every point.
///
/// The others are quantities that turn the base by [`Sensitivity::first`]'s argument: attitude
/// parameters of a system that tumbles. `J` says where items of the joints are kept, `N` directions go
/// in one sweep.
#[derive(Debug)]
pub struct Sensitivity<Sp: Algebra, J: Storage, const N: usize, const FUSED: bool> {
    pub(super) others: usize,
    pub(super) fixed: Configuration<Sp, J>,
    /// Motion of the base and of the joints.
    pub(super) velocity: Motion<Sp, f64>,
    pub(super) acceleration: Motion<Sp, f64>,
    pub(super) rates: J::Array<f64>,
    pub(super) accelerations: J::Array<f64>,
    /// Change of the base's motion by each of the other directions.
    pub(super) spun: Vec<Motion<Sp, f64>>,
    /// First derivatives, by sweeps.
    pub(super) tangents: Vec<Tangent<Sp, J, N, FUSED>>,
    pub(super) residual: J::Array<Dual<N, FUSED>>,
    pub(super) carried: Carried<Sp, J>,
    pub(super) steps: J::Array<JointStep<Sp>>,
    pub(super) directions: Directions<Sp, J>,
    pub(super) adjoint: Adjoint<Sp, J>,
    /// Momentum-free motions of the controls and of the torques' weights.
    pub(super) controls: Field<Sp, J>,
    pub(super) weights: Field<Sp, J>,
    /// Second derivatives, the lower triangle by rows as wide as all sweeps.
    pub(super) hessian: Vec<f64>,
}

impl<Sp: Algebra, J: Storage, const N: usize, const FUSED: bool> Sensitivity<Sp, J, N, FUSED> {
    /// Room for the derivatives of `tree`, with `others` directions beyond θ and θ̇.
    pub fn new(tree: &Tree<Sp>, others: usize) -> Self {
        let n = tree.joint_count();
        let directions = 2 * n + others;
        let sweeps = directions.div_ceil(N);
        Self {
            others,
            fixed: Configuration::new(tree),
            velocity: Motion::zero(),
            acceleration: Motion::zero(),
            rates: J::array(0.0, n),
            accelerations: J::array(0.0, n),
            spun: vec![Motion::zero(); others],
            tangents: (0..sweeps)
                .map(|_| Tangent {
                    velocity: Motion::zero(),
                    acceleration: Motion::zero(),
                    joints: J::array(Dual::constant(0.0), n),
                })
                .collect(),
            residual: J::array(Dual::constant(0.0), n),
            carried: Carried::new(n),
            steps: J::array(JointStep::zero(), n),
            directions: Directions::new(n, sweeps * N),
            adjoint: Adjoint::new(n),
            controls: Field::new(n),
            weights: Field::new(n),
            hessian: vec![0.0; directions * sweeps * N],
        }
    }

    /// Number of joints n.
    #[inline(always)]
    pub fn joints(&self) -> usize {
        self.steps.len()
    }

    /// Number of directions.
    #[inline(always)]
    pub fn directions(&self) -> usize {
        2 * self.joints() + self.others
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
        for (joint, &rate) in data.joints.iter().zip(dq) {
            momentum = momentum.plus_times(&joint.linear, rate);
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
        for (drag, &a) in fixed.drag.iter().zip(self.accelerations.iter()) {
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

    /// Derivatives of the acceleration of joint `j`: by θ and θ̇, and into the first places of
    /// `by_others` by the others; after [`Sensitivity::first`].
    pub fn acceleration_by(&self, j: usize, by_joints: &mut [f64], by_others: &mut [f64]) {
        self.copy(|sweep| &sweep.joints[j], by_joints, by_others);
    }

    /// Derivatives of component `i` of the base's angular velocity, as
    /// [`Sensitivity::acceleration_by`] has them.
    pub fn base_rate_by(&self, i: usize, by_joints: &mut [f64], by_others: &mut [f64]) {
        let component = |sweep| component::<Sp, J, N, FUSED>(sweep, i);
        self.copy(component, by_joints, by_others);
    }

    fn copy<'s>(
        &'s self,
        number: impl Fn(&'s Tangent<Sp, J, N, FUSED>) -> &'s Dual<N, FUSED>,
        by_joints: &mut [f64],
        by_others: &mut [f64],
    ) {
        let first = by_joints.len();
        for (to, sweep) in by_joints.chunks_mut(N).zip(&self.tangents) {
            to.copy_from_slice(&number(sweep).gradient[..to.len()]);
        }
        for (direction, to) in (first..).zip(by_others).take(self.others) {
            *to = number(&self.tangents[direction / N]).gradient[direction % N];
        }
    }

    /// Second derivatives in direction `row` and in those up to it; after [`Sensitivity::second`].
    pub fn second_by(&self, row: usize) -> &[f64] {
        &self.hessian[row * self.tangents.len() * N..][..=row]
    }
}

/// Component `i` of the base's angular velocity.
fn component<Sp: Algebra, J: Storage, const N: usize, const FUSED: bool>(
    sweep: &Tangent<Sp, J, N, FUSED>,
    i: usize,
) -> &Dual<N, FUSED> {
    &sweep.velocity.angular.components()[i]
}
