//! What depends on the joint positions alone, and the steps from body to body.

use crate::autodiff::Scalar;
use crate::dynamics::algebra::{Algebra, BodyInertia, CompositeInertia, Force, Motion, Vector};
use crate::dynamics::{Data, JointKind, Storage, Tree};

/// Everything that depends on the joint positions alone.
#[derive(Debug)]
pub(super) struct Configuration<Sp: Algebra, J: Storage> {
    pub data: Data<Sp, f64>,
    pub parents: J::Array<Option<usize>>,
    pub total_mass: f64,
    pub center: Sp::Linear<f64>,
    pub inverse_inertia: Sp::Inertia<f64>,
    pub base: BodyInertia<Sp>,
    pub bodies: J::Array<BodyInertia<Sp>>,
    /// Of the whole robot, and of what each joint carries.
    pub whole: CompositeInertia<Sp>,
    pub carried: J::Array<CompositeInertia<Sp>>,
    /// Motion of unit joint rates.
    pub axes: J::Array<Motion<Sp, f64>>,
    /// Motion of the base against unit joint rates, sign reversed.
    pub drag: J::Array<Motion<Sp, f64>>,
}

impl<Sp: Algebra, J: Storage> Configuration<Sp, J> {
    pub fn new(tree: &Tree<Sp>) -> Self {
        let n = tree.joint_count();
        let body = |mass: f64, inertia: &Sp::Inertia<f64>| BodyInertia {
            mass,
            center: Sp::Linear::<f64>::zero(),
            rotational: *inertia,
        };
        let mut base = body(tree.base_mass, &tree.base_inertia);
        base.center = tree.base_center;
        let whole = CompositeInertia::of(&base);
        let mut carried = J::array(whole, n);
        let mut parents = J::array(None, n);
        let mut bodies = J::array(base, n);
        for (j, link) in tree.links.iter().enumerate() {
            carried[j].mass = link.carried;
            parents[j] = link.parent;
            bodies[j] = body(link.mass, &link.inertia);
        }
        Self {
            whole,
            carried,
            data: Data::new(tree),
            parents,
            total_mass: tree.total_mass,
            center: Sp::Linear::<f64>::zero(),
            inverse_inertia: tree.base_inertia,
            base,
            bodies,
            axes: J::array(Motion::zero(), n),
            drag: J::array(Motion::zero(), n),
        }
    }

    /// Reads `data`.
    pub fn read(&mut self, tree: &Tree<Sp>) {
        let data = &self.data;
        self.center = data.system_center;
        self.inverse_inertia = data.inverse_inertia;
        self.whole = CompositeInertia::of(&self.base);
        let n = self.axes.len();
        let (links, joints) = (&tree.links[..n], &data.joints[..n]);
        for (j, (link, joint)) in links.iter().zip(joints).enumerate() {
            let carried = &mut self.carried[j];
            carried.moment = joint.first_moment;
            carried.inertia = joint.composite;
            if link.parent.is_none() {
                self.whole.add(carried);
            }
            let body = &mut self.bodies[j];
            body.center = joint.center;
            body.rotational = joint.inertia;
            self.axes[j] = match link.kind {
                JointKind::Revolute => {
                    let at_origin = Sp::cross_constant(&joint.axis, &joint.origin).times(-1.0);
                    Motion::new(joint.axis, at_origin)
                }
                JointKind::Prismatic => Motion::new(Sp::Angular::zero(), joint.slide),
            };
            let angular = joint.base_per_rate;
            let linear = joint.linear.times(1.0 / self.total_mass);
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
    #[inline(always)]
    pub fn base_motion(&self, rates: &[f64]) -> Motion<Sp, f64> {
        let mut motion = Motion::zero();
        for (drag, &rate) in self.drag.iter().zip(rates) {
            motion.add_times(drag, -rate);
        }
        motion
    }
}

/// Steps from body to body.
impl<Sp: Algebra, J: Storage> Configuration<Sp, J> {
    /// What the carrier of joint `j` has or, where it stands on the base, `base`.
    #[inline(always)]
    pub fn carrier<T: Copy>(&self, j: usize, of_bodies: &[T], base: T) -> T {
        self.parents[j].map_or(base, |parent| of_bodies[parent])
    }

    /// Joint `j` and those between it and the base, outermost first.
    #[inline(always)]
    pub fn path(&self, j: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(j), |&k| self.parents[k])
    }

    /// Adds what each body has to what its carrier or the base has, from the tips inwards.
    #[inline(always)]
    pub fn gather<T: Copy>(&self, of_bodies: &mut [T], base: &mut T, add: impl Fn(&mut T, &T)) {
        for j in (0..of_bodies.len()).rev() {
            let own = of_bodies[j];
            let to = match self.parents[j] {
                Some(parent) => &mut of_bodies[parent],
                None => &mut *base,
            };
            add(to, &own);
        }
    }

    /// Motions of the bodies at the joint rates `rates` on that of the base, outwards.
    #[inline(always)]
    pub fn motions(&self, base: Motion<Sp, f64>, rates: &[f64], motions: &mut [Motion<Sp, f64>]) {
        for (j, (axis, &rate)) in self.axes.iter().zip(rates).enumerate() {
            let mut motion = self.carrier(j, motions, base);
            motion.add_times(axis, rate);
            motions[j] = motion;
        }
    }
}
