//! Scratch of the algorithms: allocated once, overwritten at every evaluation.

use super::algebra::{Algebra, Vector};
use super::tree::Link;
use super::{Ldl, Tree};
use crate::autodiff::Scalar;

/// Intermediate and final results of one evaluation, for one number type.
///
/// Filled stage by stage: [`Tree::kinematics`], [`Tree::momentum`], [`Tree::base_rate`], then
/// [`Tree::mass_matrix`] and [`Tree::bias`]. Vectors are in base axes, points relative to the
/// origin of the base frame.
#[derive(Debug, Clone)]
pub struct Data<Sp: Algebra, S: Scalar> {
    pub(super) joints: Vec<JointData<Sp, S>>,
    /// Net force, and net moment about the system's mass centre, of the Newton-Euler pass.
    pub(super) net_force: Sp::Linear<S>,
    pub(super) net_torque: Sp::Angular<S>,
    /// Mass centre of the whole system, m.
    pub system_center: Sp::Linear<S>,
    /// Inverse of the composite inertia I₀ about the system's mass centre, 1/(kg m²).
    pub inverse_inertia: Sp::Inertia<S>,
    /// Angular velocity of the base ω₀, rad/s.
    pub base_rate: Sp::Angular<S>,
    /// Reduced inertia matrix H, n×n by rows; only the lower triangle is filled.
    pub mass_matrix: Vec<S>,
    /// Reduced Coriolis force Cθ̇, N·m or N; length n.
    pub bias: Vec<S>,
    /// Factors of H.
    pub factors: Ldl<S>,
}

/// Results of one joint, and of the body that it moves.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointData<Sp: Algebra, S: Scalar> {
    // Kinematics.
    pub orientation: Sp::Orientation<S>,
    pub origin: Sp::Linear<S>,
    pub axis: Sp::Angular<S>,
    pub slide: Sp::Linear<S>,
    pub center: Sp::Linear<S>,
    pub inertia: Sp::Inertia<S>,
    // Composite rigid body about the base origin.
    pub first_moment: Sp::Linear<S>,
    pub composite: Sp::Inertia<S>,
    // Momentum of the unit rate.
    pub linear: Sp::Linear<S>,
    pub angular: Sp::Angular<S>,
    pub about_center: Sp::Angular<S>,
    pub base_per_rate: Sp::Angular<S>,
    // Newton-Euler.
    pub omega: Sp::Angular<S>,
    pub alpha: Sp::Angular<S>,
    pub acceleration: Sp::Linear<S>,
    pub force: Sp::Linear<S>,
    pub torque: Sp::Angular<S>,
}

impl<Sp: Algebra, S: Scalar> JointData<Sp, S> {
    fn new(link: &Link<Sp>) -> Self {
        let (linear, angular) = (Sp::Linear::zero(), Sp::Angular::zero());
        let inertia = Sp::inertia(&Sp::aligned(), &link.inertia);
        Self {
            orientation: Sp::aligned(),
            origin: linear,
            axis: angular,
            slide: linear,
            center: linear,
            inertia,
            first_moment: linear,
            composite: inertia,
            linear,
            angular,
            about_center: angular,
            base_per_rate: angular,
            omega: angular,
            alpha: angular,
            acceleration: linear,
            force: linear,
            torque: angular,
        }
    }
}

impl<Sp: Algebra, S: Scalar> Data<Sp, S> {
    /// Scratch for `tree`.
    pub fn new(tree: &Tree<Sp>) -> Self {
        let n = tree.joint_count();
        Self {
            joints: tree.links.iter().map(JointData::new).collect(),
            net_force: Sp::Linear::zero(),
            net_torque: Sp::Angular::zero(),
            system_center: Sp::Linear::zero(),
            inverse_inertia: Sp::inertia(&Sp::aligned(), &tree.base_inertia),
            base_rate: Sp::Angular::zero(),
            mass_matrix: vec![S::zero(); n * n],
            bias: vec![S::zero(); n],
            factors: Ldl::new(n),
        }
    }
}

impl<Sp: Algebra> Data<Sp, f64> {
    /// Hands to `visit` all that [`Tree::mass_matrix`] leaves of the pose and the momenta, and the
    /// factors of H.
    #[inline(always)]
    pub(super) fn visit(&mut self, visit: &mut impl FnMut(&mut [f64])) {
        for joint in &mut self.joints {
            Sp::visit_orientation(&mut joint.orientation, visit);
            visit(joint.origin.components_mut());
            visit(joint.axis.components_mut());
            visit(joint.slide.components_mut());
            visit(joint.linear.components_mut());
        }
        visit(self.system_center.components_mut());
        visit(self.base_rate.components_mut());
        visit(&mut self.mass_matrix);
        self.factors.visit(visit);
    }
}
