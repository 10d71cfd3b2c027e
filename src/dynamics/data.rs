//! Scratch of the algorithms: allocated once, overwritten at every evaluation.

use super::algebra::{Algebra, Vector};
use super::{Ldl, Tree};
use crate::autodiff::Scalar;

/// Intermediate and final results of one evaluation, for one number type.
///
/// Filled stage by stage: [`Tree::kinematics`], [`Tree::momentum`], [`Tree::base_rate`], then
/// [`Tree::mass_matrix`] and [`Tree::bias`]. Vectors are in base axes, points relative to the
/// origin of the base frame.
#[derive(Debug, Clone)]
pub struct Data<Sp: Algebra, S: Scalar> {
    // Kinematics, one a joint.
    pub(super) orientation: Vec<Sp::Orientation<S>>,
    pub(super) origin: Vec<Sp::Linear<S>>,
    pub(super) axis: Vec<Sp::Angular<S>>,
    pub(super) slide: Vec<Sp::Linear<S>>,
    pub(super) center: Vec<Sp::Linear<S>>,
    pub(super) inertia: Vec<Sp::Inertia<S>>,
    // Composite rigid bodies about the base origin.
    pub(super) first_moment: Vec<Sp::Linear<S>>,
    pub(super) composite: Vec<Sp::Inertia<S>>,
    // Momentum of the unit rate of each joint.
    pub(super) linear: Vec<Sp::Linear<S>>,
    pub(super) angular: Vec<Sp::Angular<S>>,
    pub(super) about_center: Vec<Sp::Angular<S>>,
    pub(super) base_per_rate: Vec<Sp::Angular<S>>,
    // Newton-Euler.
    pub(super) omega: Vec<Sp::Angular<S>>,
    pub(super) alpha: Vec<Sp::Angular<S>>,
    pub(super) acceleration: Vec<Sp::Linear<S>>,
    pub(super) force: Vec<Sp::Linear<S>>,
    pub(super) torque: Vec<Sp::Angular<S>>,
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

impl<Sp: Algebra, S: Scalar> Data<Sp, S> {
    /// Scratch for `tree`.
    pub fn new(tree: &Tree<Sp>) -> Self {
        let n = tree.joint_count();
        let linear = vec![Sp::Linear::<S>::zero(); n];
        let angular = vec![Sp::Angular::<S>::zero(); n];
        let inertia: Vec<Sp::Inertia<S>> = tree
            .links
            .iter()
            .map(|link| Sp::inertia(&Sp::aligned(), &link.inertia))
            .collect();
        Self {
            orientation: vec![Sp::aligned(); n],
            origin: linear.clone(),
            axis: angular.clone(),
            slide: linear.clone(),
            center: linear.clone(),
            first_moment: linear.clone(),
            composite: inertia.clone(),
            linear: linear.clone(),
            angular: angular.clone(),
            about_center: angular.clone(),
            base_per_rate: angular.clone(),
            omega: angular.clone(),
            alpha: angular.clone(),
            acceleration: linear.clone(),
            force: linear,
            torque: angular,
            net_force: Sp::Linear::zero(),
            net_torque: Sp::Angular::zero(),
            system_center: Sp::Linear::zero(),
            inverse_inertia: Sp::inertia(&Sp::aligned(), &tree.base_inertia),
            inertia,
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
    pub(super) fn visit(&mut self, visit: &mut impl FnMut(&mut [f64])) {
        for j in 0..self.origin.len() {
            Sp::visit_orientation(&mut self.orientation[j], visit);
            visit(self.origin[j].components_mut());
            visit(self.axis[j].components_mut());
            visit(self.slide[j].components_mut());
            visit(self.linear[j].components_mut());
        }
        visit(self.system_center.components_mut());
        visit(self.base_rate.components_mut());
        visit(&mut self.mass_matrix);
        self.factors.visit(visit);
    }
}
