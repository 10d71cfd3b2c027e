//! First and second derivatives of the free motion by the structure of the recursions.
//!
//! The joint accelerations q̈ = −H⁻¹Cθ̇ are those at which one inverse-dynamics pass over the whole
//! robot, base included, needs no force anywhere. That pass is all that is differentiated:
//!
//! - First order: with base motion and accelerations held, dual numbers carry the pass; its
//!   residual and the factors of H give their derivatives (`first`). Nothing is differentiated
//!   through a factorisation.
//! - Second order: the residual weighted with multipliers is a scalar, of which a hand-written
//!   adjoint has the gradient (`second`). One sweep of dual numbers through it, seeded with the
//!   first derivatives, gives the whole Hessian.
//!
//! Derivatives of whatever belongs to a body are those seen from that body: its axis, its inertia
//! and all it carries stay as they are, and only the step from a body to the next adds a term, to
//! the one direction that is its joint's position: −S × motion outwards, S ×* force inwards. So all
//! positions stay plain numbers, and dual numbers are multiplied by them.

mod first;
mod second;
mod torque;

use super::screw::{BodyMass, Components, Screw, scaled, sum, sum_scaled};
use super::space::{Space, Vector};
use super::{Data, JointKind, Tree};
use crate::autodiff::{Dual, Over, Scalar, dispatch};

/// Free motion at one point with its derivatives, in directions z = [θ, θ̇, others]: allocated
/// once, overwritten at every point.
///
/// The others are quantities that turn the base by [`Sensitivity::first`]'s argument: attitude
/// parameters of a system that tumbles. `N` directions go in one sweep.
#[derive(Debug)]
pub struct Sensitivity<Sp: Space, const N: usize, const FUSED: bool> {
    joints: usize,
    others: usize,
    fixed: Configuration<Sp>,
    /// Motion of the base and of the joints.
    velocity: Screw<Sp, f64>,
    acceleration: Screw<Sp, f64>,
    rates: Vec<f64>,
    accelerations: Vec<f64>,
    /// Change of the base's motion by each of the other directions.
    spun: Vec<Screw<Sp, f64>>,
    /// First derivatives, by sweeps.
    tangents: Vec<Tangent<Sp, N, FUSED>>,
    passes: Passes<Sp, Dual<N, FUSED>>,
    adjoint: second::Adjoint<Sp, Dual<N, FUSED>>,
    torque: torque::Fields<Sp, Dual<N, FUSED>>,
    /// Second derivatives, by rows as wide as all sweeps.
    hessian: Vec<f64>,
}

/// Everything that depends on the joint positions alone.
#[derive(Debug)]
struct Configuration<Sp: Space> {
    data: Data<Sp, f64>,
    parents: Vec<Option<usize>>,
    total_mass: f64,
    center: Sp::Length<f64>,
    inverse_inertia: Sp::Moments,
    base: BodyMass<Sp>,
    bodies: Vec<BodyMass<Sp>>,
    /// Motion of unit joint rates.
    axes: Vec<Screw<Sp, f64>>,
    /// Motion of the base against unit joint rates, sign reversed.
    drag: Vec<Screw<Sp, f64>>,
}

/// Base motion and accelerations with their derivatives in the directions of one sweep.
#[derive(Debug)]
struct Tangent<Sp: Space, const N: usize, const FUSED: bool> {
    velocity: Screw<Sp, Dual<N, FUSED>>,
    acceleration: Screw<Sp, Dual<N, FUSED>>,
    joints: Vec<Dual<N, FUSED>>,
}

/// Motions and forces of the bodies.
#[derive(Debug)]
struct Passes<Sp: Space, S: Scalar> {
    velocity: Vec<Screw<Sp, S>>,
    acceleration: Vec<Screw<Sp, S>>,
    force: Vec<Screw<Sp, S>>,
    residual: Vec<S>,
}

/// A nalgebra vector as an array.
fn array<C: Components<f64>>(from: &[f64]) -> C {
    let mut to = C::zero();
    to.as_mut().copy_from_slice(from);
    to
}

impl<Sp: Space> Configuration<Sp> {
    fn new(tree: &Tree<Sp>) -> Self {
        let n = tree.joint_count();
        let body = |mass: f64, inertia: &Sp::Inertia<f64>| BodyMass {
            mass,
            center: Sp::Length::<f64>::zero(),
            moments: *inertia,
        };
        let mut base = body(tree.base_mass, &tree.base_inertia);
        base.center = array(tree.base_center.components());
        Self {
            data: Data::new(tree),
            parents: tree.links.iter().map(|link| link.parent).collect(),
            total_mass: tree.total_mass,
            center: Sp::Length::<f64>::zero(),
            inverse_inertia: tree.base_inertia,
            base,
            bodies: tree
                .links
                .iter()
                .map(|l| body(l.mass, &l.inertia))
                .collect(),
            axes: vec![Screw::zero(); n],
            drag: vec![Screw::zero(); n],
        }
    }

    /// Reads `data`.
    fn read(&mut self, tree: &Tree<Sp>) {
        let data = &self.data;
        self.center = array(data.system_center.components());
        self.inverse_inertia = data.inverse_inertia;
        for (j, link) in tree.links.iter().enumerate() {
            let body = &mut self.bodies[j];
            body.center = array(data.center[j].components());
            body.moments = data.inertia[j];
            self.axes[j] = match link.kind {
                JointKind::Revolute => {
                    let axis: Sp::Angle<f64> = array(data.axis[j].components());
                    let origin: Sp::Length<f64> = array(data.origin[j].components());
                    Screw {
                        angular: axis,
                        linear: scaled(Sp::carry(&axis, &origin), -1.0),
                    }
                }
                JointKind::Prismatic => Screw {
                    angular: Sp::Angle::<f64>::zero(),
                    linear: array(data.slide[j].components()),
                },
            };
            let turn: Sp::Angle<f64> = array(data.base_per_rate[j].components());
            let momentum: Sp::Length<f64> = array(data.linear[j].components());
            let linear = scaled(momentum, 1.0 / self.total_mass);
            self.drag[j] = Screw {
                angular: turn,
                linear: sum_scaled(linear, &Sp::carry(&turn, &self.center), -1.0),
            };
        }
    }

    /// Motion that gives the whole robot, its joints locked, the momentum `wrench`.
    #[inline(always)]
    fn settled<S: Over<f64>>(&self, wrench: &Screw<Sp, S>) -> Screw<Sp, S> {
        let about_center = sum_scaled(
            wrench.angular,
            &Sp::lever(&self.center, &wrench.linear),
            -1.0,
        );
        let angular = Sp::spin(&self.inverse_inertia, &about_center);
        let linear = scaled(wrench.linear, 1.0 / self.total_mass);
        Screw {
            angular,
            linear: sum_scaled(linear, &Sp::carry(&angular, &self.center), -1.0),
        }
    }

    /// Base motion that keeps the momentum at zero at the given joint rates.
    fn base_motion(&self, rates: &[f64]) -> Screw<Sp, f64> {
        let mut motion = Screw::zero();
        for (drag, &rate) in self.drag.iter().zip(rates) {
            motion.add_scaled(drag, -rate);
        }
        motion
    }
}

impl<Sp: Space, const N: usize, const FUSED: bool> Sensitivity<Sp, N, FUSED> {
    /// Room for the derivatives of `tree`, with `others` directions beyond θ and θ̇.
    pub fn new(tree: &Tree<Sp>, others: usize) -> Self {
        let n = tree.joint_count();
        let directions = 2 * n + others;
        let sweeps = directions.div_ceil(N);
        Self {
            joints: n,
            others,
            fixed: Configuration::new(tree),
            velocity: Screw::zero(),
            acceleration: Screw::zero(),
            rates: vec![0.0; n],
            accelerations: vec![0.0; n],
            spun: vec![Screw::zero(); others],
            tangents: (0..sweeps)
                .map(|_| Tangent {
                    velocity: Screw::zero(),
                    acceleration: Screw::zero(),
                    joints: vec![Dual::constant(0.0); n],
                })
                .collect(),
            passes: Passes {
                velocity: vec![Screw::zero(); n],
                acceleration: vec![Screw::zero(); n],
                force: vec![Screw::zero(); n],
                residual: vec![Dual::constant(0.0); n],
            },
            adjoint: second::Adjoint::new(n),
            torque: torque::Fields::new(n, n.div_ceil(N)),
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
        let omega: Sp::Angle<f64> = array(data.base_rate.components());
        let mut momentum = Sp::Length::<f64>::zero();
        for (linear, &rate) in data.linear.iter().zip(dq) {
            momentum = sum_scaled(momentum, &array(linear.components()), rate);
        }
        let turning = Sp::carry(&omega, &fixed.center);
        self.velocity = Screw {
            angular: omega,
            linear: sum_scaled(scaled(turning, -1.0), &momentum, -1.0 / fixed.total_mass),
        };
        // The bias pass takes the base's origin as at rest and its acceleration as that of the
        // point of the base: free of forces once more, then as seen at the origin.
        let pushed: Sp::Length<f64> = array(data.net_force.components());
        let twisted: Sp::Angle<f64> = array(data.net_torque.components());
        let mut acceleration = fixed.settled(&Screw {
            angular: sum(twisted, &Sp::lever(&fixed.center, &pushed)),
            linear: pushed,
        });
        for (drag, &a) in fixed.drag.iter().zip(&self.accelerations) {
            acceleration.add_scaled(drag, a);
        }
        self.acceleration = Screw {
            angular: scaled(acceleration.angular, -1.0),
            linear: sum(
                scaled(acceleration.linear, -1.0),
                &scaled(Sp::sweep(&omega, &self.velocity.linear), -1.0),
            ),
        };
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
        self.tangents[direction / N].velocity.angular.as_ref()[i].gradient[direction % N]
    }

    /// Second derivative in two directions, `row` ≥ `column`; after [`Sensitivity::second`].
    pub fn second_by(&self, row: usize, column: usize) -> f64 {
        self.hessian[row * self.tangents.len() * N + column]
    }

    /// Lane of a direction in the sweep that starts at direction `start`.
    #[inline(always)]
    fn lane(start: usize, direction: usize) -> Option<usize> {
        direction.checked_sub(start).filter(|&lane| lane < N)
    }
}
