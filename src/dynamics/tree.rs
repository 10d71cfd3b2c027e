//! A robot compiled for evaluation: only what the recursions read, in aligned frames.

use super::algebra::Algebra;
use super::{JointKind, Mount, Placement};
use nalgebra::Matrix3;

/// One body with its joint. The base has no joint and is kept apart.
#[derive(Debug, Clone)]
pub(super) struct Link<Sp: Algebra> {
    pub parent: Option<usize>,
    pub kind: JointKind,
    /// Sense of rotation about the plane's normal; +1 in space.
    pub sign: f64,
    /// Joint frame in the parent's frame at position zero.
    pub fixed: Sp::Orientation<f64>,
    /// Joint origin in the parent's frame, m.
    pub offset: Sp::Linear<f64>,
    /// Direction of sliding in the joint frame; unused for revolute joints.
    pub slide: Sp::Linear<f64>,
    pub mass: f64,
    pub center: Sp::Linear<f64>,
    pub inertia: Sp::Inertia<f64>,
    /// Whether the mass is the same at all positions of the joint: that of a body symmetric about
    /// the joint's axis which carries no others.
    pub symmetric: bool,
    /// Mass of this body and all it carries, kg.
    pub carried: f64,
}

/// A [`Model`](super::Model) compiled for the plane or for space.
#[derive(Debug, Clone)]
pub struct Tree<Sp: Algebra> {
    pub(super) links: Vec<Link<Sp>>,
    pub(super) base_mass: f64,
    pub(super) base_center: Sp::Linear<f64>,
    pub(super) base_inertia: Sp::Inertia<f64>,
    pub(super) total_mass: f64,
    /// Rotation from each body's frame, and from the base's, to the one it is compiled in.
    pub(super) frames: Vec<Matrix3<f64>>,
    pub(super) base_frame: Matrix3<f64>,
    /// Of each joint's origin above the base's along the plane's normal, m; zero in space.
    pub(super) heights: Vec<f64>,
    pub(super) end_effector: Option<Mount<Sp>>,
}

impl<Sp: Algebra> Tree<Sp> {
    /// Number of joints n.
    pub fn joint_count(&self) -> usize {
        self.links.len()
    }

    /// Mass of all bodies together, kg.
    pub fn total_mass(&self) -> f64 {
        self.total_mass
    }

    /// The frame `placement` in the body of joint `link` (`None`: the base).
    ///
    /// In the plane its heading is that of its x axis, or of its y axis where x stands on the
    /// plane.
    pub fn mount(&self, link: Option<usize>, placement: &Placement) -> Mount<Sp> {
        let body = self.body_axes(link);
        let offset = body * placement.translation;
        Mount {
            link,
            orientation: Sp::constant_orientation(&(body * placement.rotation)),
            offset: Sp::constant_vector(&offset),
            height: link.map_or(0.0, |j| self.heights[j]) + offset.z,
        }
    }

    /// Rotation from the frame of a body, as the model has it, to the axes it is compiled in, of
    /// which the first two span the plane of a planar robot.
    pub fn body_axes(&self, link: Option<usize>) -> &Matrix3<f64> {
        link.map_or(&self.base_frame, |j| &self.frames[j])
    }

    /// Whether joint `k` moves the body of joint `link`.
    pub(super) fn carries(&self, k: usize, mut link: Option<usize>) -> bool {
        while let Some(j) = link.filter(|&j| j > k) {
            link = self.links[j].parent;
        }
        link == Some(k)
    }

    /// Sums up what each joint carries.
    pub(super) fn assemble(
        mut links: Vec<Link<Sp>>,
        base_mass: f64,
        base_center: Sp::Linear<f64>,
        base_inertia: Sp::Inertia<f64>,
        frames: Vec<Matrix3<f64>>,
        base_frame: Matrix3<f64>,
    ) -> Self {
        for j in (0..links.len()).rev() {
            if let Some(parent) = links[j].parent {
                links[parent].carried += links[j].carried;
            }
        }
        let total_mass = base_mass
            + links
                .iter()
                .filter(|link| link.parent.is_none())
                .map(|link| link.carried)
                .sum::<f64>();
        Self {
            heights: vec![0.0; links.len()],
            links,
            base_mass,
            base_center,
            base_inertia,
            total_mass,
            frames,
            base_frame,
            end_effector: None,
        }
    }
}
