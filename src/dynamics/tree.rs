//! A model compiled for evaluation: only what the recursions read, in aligned frames.

use super::planarity::zero_poses;
use super::space::{Planar, Space, Spatial, Symmetric};
use super::{Inertia, JointKind, Model, Mount};
use nalgebra::{Matrix3, Rotation3, Vector3};

/// One body with its joint. The base has no joint and is kept apart.
#[derive(Debug, Clone)]
pub(super) struct Link<Sp: Space> {
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

/// A [`Model`] compiled for the plane or for space.
#[derive(Debug, Clone)]
pub struct Tree<Sp: Space> {
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

impl<Sp: Space> Tree<Sp> {
    /// Number of joints n.
    pub fn joint_count(&self) -> usize {
        self.links.len()
    }

    /// Mass of all bodies together, kg.
    pub fn total_mass(&self) -> f64 {
        self.total_mass
    }

    /// Whether joint `k` moves the body of joint `link`.
    pub(super) fn carries(&self, k: usize, mut link: Option<usize>) -> bool {
        while let Some(j) = link.filter(|&j| j > k) {
            link = self.links[j].parent;
        }
        link == Some(k)
    }

    fn assemble(
        mut links: Vec<Link<Sp>>,
        base_mass: f64,
        base_center: Sp::Linear<f64>,
        base_inertia: Sp::Inertia<f64>,
        model: &Model,
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
        let mut tree = Self {
            links,
            base_mass,
            base_center,
            base_inertia,
            total_mass,
            frames,
            base_frame,
            heights: heights::<Sp>(model),
            end_effector: None,
        };
        tree.end_effector = model
            .end_effector()
            .map(|(link, placement)| tree.mount(*link, placement));
        tree
    }
}

/// Heights of the joints' origins in the plane; they do not change.
fn heights<Sp: Space>(model: &Model) -> Vec<f64> {
    match model.plane().filter(|_| Sp::LENGTHS == Planar::LENGTHS) {
        Some(plane) => zero_poses(model.joints())
            .iter()
            .map(|(_, origin)| plane.basis.column(2).dot(origin))
            .collect(),
        None => vec![0.0; model.joint_count()],
    }
}

impl Tree<Planar> {
    /// The planar form of a model, or `None` where its motion leaves the plane.
    pub fn planar(model: &Model) -> Option<Self> {
        let basis = model.plane()?.basis;
        let poses = zero_poses(model.joints());
        let flat = |v: Vector3<f64>| (basis.transpose() * v).xy();
        let about_normal = |inertia: &Inertia| {
            let normal = basis.column(2);
            normal.dot(&(inertia.rotational() * normal))
        };
        let links = model
            .joints()
            .iter()
            .zip(&poses)
            .map(|(joint, (rotation, origin))| {
                let carrier = joint
                    .parent
                    .map_or(Vector3::zeros(), |parent| poses[parent].1);
                let inertia = joint.body.inertia.placed(rotation, &Vector3::zeros());
                let axis = rotation * joint.axis.as_ref();
                Link {
                    parent: joint.parent,
                    kind: joint.kind,
                    sign: axis.dot(&basis.column(2)).signum(),
                    fixed: Planar::aligned(),
                    offset: flat(origin - carrier),
                    slide: flat(axis),
                    mass: inertia.mass(),
                    center: flat(*inertia.center()),
                    inertia: about_normal(&inertia),
                    // In the plane no constant but the distance of the mass from the axis enters.
                    symmetric: false,
                    carried: inertia.mass(),
                }
            })
            .collect();
        let frames = poses
            .iter()
            .map(|(rotation, _)| basis.transpose() * rotation)
            .collect();
        let base = &model.base().inertia;
        Some(Self::assemble(
            links,
            base.mass(),
            flat(*base.center()),
            about_normal(base),
            model,
            frames,
            basis.transpose(),
        ))
    }
}

impl Tree<Spatial> {
    /// The spatial form of a model; serves planar ones as well.
    pub fn spatial(model: &Model) -> Self {
        // Each joint frame is turned so that its axis is z.
        let alignment: Vec<Matrix3<f64>> = model
            .joints()
            .iter()
            .map(|joint| match joint.kind {
                JointKind::Revolute => Rotation3::rotation_between(&Vector3::z(), &joint.axis)
                    .unwrap_or_else(|| {
                        Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
                    })
                    .into_inner(),
                JointKind::Prismatic => Matrix3::identity(),
            })
            .collect();
        let columns = |m: Matrix3<f64>| [0, 1, 2].map(|i| m.column(i).into_owned());
        let links = model
            .joints()
            .iter()
            .zip(&alignment)
            .enumerate()
            .map(|(j, (joint, aligned))| {
                let parent = joint
                    .parent
                    .map_or(Matrix3::identity(), |p| alignment[p].transpose());
                let inertia = joint
                    .body
                    .inertia
                    .placed(&aligned.transpose(), &Vector3::zeros());
                Link {
                    parent: joint.parent,
                    kind: joint.kind,
                    sign: 1.0,
                    fixed: columns(parent * joint.placement.rotation * aligned),
                    offset: parent * joint.placement.translation,
                    slide: *joint.axis,
                    mass: inertia.mass(),
                    center: *inertia.center(),
                    inertia: Symmetric::from_matrix(inertia.rotational()),
                    symmetric: joint.kind == JointKind::Revolute
                        && model.joints().iter().all(|other| other.parent != Some(j))
                        && is_symmetric(&inertia),
                    carried: inertia.mass(),
                }
            })
            .collect();
        let base = &model.base().inertia;
        Self::assemble(
            links,
            base.mass(),
            *base.center(),
            Symmetric::from_matrix(base.rotational()),
            model,
            alignment.iter().map(Matrix3::transpose).collect(),
            Matrix3::identity(),
        )
    }
}

/// Departure from symmetry, relative to size and moments of inertia, that is rounding.
const ROUNDING: f64 = 1e-12;

/// Whether a body is symmetric about the z axis of its frame.
fn is_symmetric(inertia: &Inertia) -> bool {
    let (center, moments) = (inertia.center(), inertia.rotational());
    let skew = [
        moments.m11 - moments.m22,
        moments.m12,
        moments.m13,
        moments.m23,
    ];
    center.xy().amax() <= ROUNDING * center.amax()
        && skew
            .iter()
            .all(|gap| gap.abs() <= ROUNDING * moments.amax())
}
