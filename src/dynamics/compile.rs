//! Compiles bodies and joints to a [`Tree`], in the plane or in space.

use super::algebra::{Algebra, Planar, Spatial, Symmetric};
use super::planarity::{Plane, zero_poses};
use super::tree::Link;
use super::{Body, Inertia, Joint, JointKind, Tree};
use nalgebra::{Matrix3, Rotation3, Vector3};

impl Tree<Planar> {
    /// The tree of bodies that move in `plane`, without an end effector.
    pub(super) fn in_plane(plane: &Plane, base: &Body, joints: &[Joint]) -> Self {
        let basis = plane.basis;
        let poses = zero_poses(joints);
        let flat = |v: Vector3<f64>| (basis.transpose() * v).xy();
        let about_normal = |inertia: &Inertia| {
            let normal = basis.column(2);
            normal.dot(&(inertia.rotational() * normal))
        };
        let links = joints
            .iter()
            .zip(&poses)
            .map(|(joint, pose)| {
                let carrier = joint
                    .parent
                    .map_or(Vector3::zeros(), |parent| poses[parent].translation);
                let inertia = joint.body.inertia.placed(&pose.rotation, &Vector3::zeros());
                let axis = pose.rotation * joint.axis.as_ref();
                Link {
                    parent: joint.parent,
                    kind: joint.kind,
                    sign: axis.dot(&basis.column(2)).signum(),
                    fixed: Planar::aligned(),
                    offset: flat(pose.translation - carrier),
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
            .map(|pose| basis.transpose() * pose.rotation)
            .collect();
        let heights = poses
            .iter()
            .map(|pose| basis.column(2).dot(&pose.translation));
        let base = &base.inertia;
        Self {
            heights: heights.collect(),
            ..Self::assemble(
                links,
                base.mass(),
                flat(*base.center()),
                about_normal(base),
                frames,
                basis.transpose(),
            )
        }
    }
}

impl Tree<Spatial> {
    /// The tree of bodies in space, without an end effector.
    pub(super) fn in_space(base: &Body, joints: &[Joint]) -> Self {
        // Each joint frame is turned so that its axis is z.
        let alignment: Vec<Matrix3<f64>> = joints
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
        let links = joints
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
                        && joints.iter().all(|other| other.parent != Some(j))
                        && is_symmetric(&inertia),
                    carried: inertia.mass(),
                }
            })
            .collect();
        let base = &base.inertia;
        Self::assemble(
            links,
            base.mass(),
            *base.center(),
            Symmetric::from_matrix(base.rotational()),
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
