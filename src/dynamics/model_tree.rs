//! The trees of a [`Model`]: in the plane and in space.

use super::algebra::{Algebra, Planar, Spatial};
use super::{Model, Tree};

impl Tree<Planar> {
    /// The planar form of a model, or `None` where its motion leaves the plane.
    pub fn planar(model: &Model) -> Option<Self> {
        let tree = Self::in_plane(model.plane()?, model.base(), model.joints());
        Some(tree.with_end_effector(model))
    }
}

impl Tree<Spatial> {
    /// The spatial form of a model; serves planar ones as well.
    pub fn spatial(model: &Model) -> Self {
        Self::in_space(model.base(), model.joints()).with_end_effector(model)
    }
}

impl<Sp: Algebra> Tree<Sp> {
    fn with_end_effector(mut self, model: &Model) -> Self {
        let end_effector = model.end_effector();
        self.end_effector = end_effector.map(|end| self.mount(end.joint, &end.placement));
        self
    }
}
