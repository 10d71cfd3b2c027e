//! What depends on the joint positions alone, and the steps from body to body.

use super::workspace::in_sweep;
use crate::autodiff::{Dual, Scalar};
use crate::dynamics::algebra::{Algebra, BodyInertia, Force, Motion, Vector};
use crate::dynamics::{Data, JointKind, Tree};

/// Everything that depends on the joint positions alone.
#[derive(Debug)]
pub(super) struct Configuration<Sp: Algebra> {
    pub data: Data<Sp, f64>,
    pub parents: Vec<Option<usize>>,
    pub total_mass: f64,
    pub center: Sp::Linear<f64>,
    pub inverse_inertia: Sp::Inertia<f64>,
    pub base: BodyInertia<Sp>,
    pub bodies: Vec<BodyInertia<Sp>>,
    /// Motion of unit joint rates.
    pub axes: Vec<Motion<Sp, f64>>,
    /// Motion of the base against unit joint rates, sign reversed.
    pub drag: Vec<Motion<Sp, f64>>,
}

impl<Sp: Algebra> Configuration<Sp> {
    pub fn new(tree: &Tree<Sp>) -> Self {
        let n = tree.joint_count();
        let body = |mass: f64, inertia: &Sp::Inertia<f64>| BodyInertia {
            mass,
            center: Sp::Linear::<f64>::zero(),
            rotational: *inertia,
        };
        let mut base = body(tree.base_mass, &tree.base_inertia);
        base.center = tree.base_center;
        Self {
            data: Data::new(tree),
            parents: tree.links.iter().map(|link| link.parent).collect(),
            total_mass: tree.total_mass,
            center: Sp::Linear::<f64>::zero(),
            inverse_inertia: tree.base_inertia,
            base,
            bodies: tree
                .links
                .iter()
                .map(|l| body(l.mass, &l.inertia))
                .collect(),
            axes: vec![Motion::zero(); n],
            drag: vec![Motion::zero(); n],
        }
    }

    /// Reads `data`.
    pub fn read(&mut self, tree: &Tree<Sp>) {
        let data = &self.data;
        self.center = data.system_center;
        self.inverse_inertia = data.inverse_inertia;
        for (j, link) in tree.links.iter().enumerate() {
            let body = &mut self.bodies[j];
            body.center = data.center[j];
            body.rotational = data.inertia[j];
            self.axes[j] = match link.kind {
                JointKind::Revolute => {
                    let axis = data.axis[j];
                    let at_origin = Sp::cross_constant(&axis, &data.origin[j]).times(-1.0);
                    Motion::new(axis, at_origin)
                }
                JointKind::Prismatic => Motion::new(Sp::Angular::zero(), data.slide[j]),
            };
            let angular = data.base_per_rate[j];
            let linear = data.linear[j].times(1.0 / self.total_mass);
            let about_center = Sp::cross_constant(&angular, &self.center);
            self.drag[j] = Motion::new(angular, linear.plus_times(&about_center, -1.0));
        }
    }

    /// Motion that gives the whole robot, its joints locked, the momentum `wrench`.
    #[inline(always)]
    pub fn settled<S: Scalar>(&self, wrench: &Force<Sp, S>) -> Motion<Sp, S> {
        let moment = Sp::moment(&self.center, &wrench.linear);
        let about_center = wrench.angular.plus_times(&moment, -1.0);
        let angular = Sp::apply_constant(&self.inverse_inertia, &about_center);
        let linear = wrench.linear.times(1.0 / self.total_mass);
        let at_origin = Sp::cross_constant(&angular, &self.center);
        Motion::new(angular, linear.plus_times(&at_origin, -1.0))
    }

    /// Base motion that keeps the momentum at zero at the given joint rates.
    pub fn base_motion(&self, rates: &[f64]) -> Motion<Sp, f64> {
        let mut motion = Motion::zero();
        for (drag, &rate) in self.drag.iter().zip(rates) {
            motion.add_times(drag, -rate);
        }
        motion
    }
}

/// Steps from body to body.
impl<Sp: Algebra> Configuration<Sp> {
    /// Gives body `j` the motion of its carrier or, where it stands on the base, `base`.
    #[inline(always)]
    pub fn carried<'m, S: Scalar>(
        &self,
        j: usize,
        motions: &'m mut [Motion<Sp, S>],
        base: &Motion<Sp, S>,
    ) -> &'m mut Motion<Sp, S> {
        let (before, rest) = motions.split_at_mut(j);
        let from = match self.parents[j] {
            Some(parent) => &before[parent],
            None => base,
        };
        rest[0] = *from;
        &mut rest[0]
    }

    /// Adds the force on body `j`, as its carrier sees it, to that on the carrier or, where it
    /// stands on the base, to `base`.
    #[inline(always)]
    pub fn hand_on<const N: usize, const FUSED: bool>(
        &self,
        start: usize,
        j: usize,
        forces: &mut [Force<Sp, Dual<N, FUSED>>],
        base: &mut Force<Sp, Dual<N, FUSED>>,
    ) {
        let (before, rest) = forces.split_at_mut(j);
        let force = &rest[0];
        let to = match self.parents[j] {
            Some(parent) => &mut before[parent],
            None => base,
        };
        to.add(force);
        let direction = in_sweep::<N>(start, j);
        if direction.is_some() {
            to.add_derivative(direction, &self.axes[j].cross_force(&force.value()), 1.0);
        }
    }
}
