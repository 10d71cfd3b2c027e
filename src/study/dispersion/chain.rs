//! The robot as the replays see it: frames that every sample shares, and the mass properties that
//! each has of its own.
//!
//! Every body's frame is turned so that its joint's axis is z, and in the plane the base's so that z
//! is the plane's normal.

use crate::dynamics::{Inertia, JointKind, Model};
use nalgebra::{Matrix3, Rotation3, SymmetricEigen, Vector3};

/// A joint as all samples share it.
#[derive(Debug, Clone)]
pub(super) struct Link {
    /// The joint that carries this one; `None` for the base.
    pub parent: Option<usize>,
    pub kind: JointKind,
    /// Joint frame in the parent's at position zero, by columns.
    pub fixed: [[f64; 3]; 3],
    /// Joint origin in the parent's frame, m.
    pub offset: [f64; 3],
    /// Direction of sliding in the joint frame.
    pub slide: [f64; 3],
}

/// A body's nominal mass properties in its frame, and how perturbations change them.
#[derive(Debug, Clone)]
pub(super) struct Mass {
    pub mass: f64,
    pub center: Vector3<f64>,
    pub inertia: Matrix3<f64>,
    /// What is added to the inertia for each factor on a second moment that is 1 above 1: three in
    /// space, of which the plane uses the sum.
    pub by_factor: [Matrix3<f64>; 3],
    /// From the model's frame of the body to the one used here.
    pub turn: Matrix3<f64>,
}

/// The robot compiled for replays.
#[derive(Debug, Clone)]
pub(super) struct Chain {
    pub links: Vec<Link>,
    /// The base first.
    pub masses: Vec<Mass>,
    /// Whether all motion stays in the plane of x and y.
    pub planar: bool,
}

impl Chain {
    pub fn new(model: &Model) -> Self {
        let planar = model.plane().is_some();
        let base_axes = model
            .plane()
            .map_or(Matrix3::identity(), |plane| plane.basis);
        let normals = normals(model);
        let aligned: Vec<Matrix3<f64>> = model
            .joints()
            .iter()
            .zip(&normals)
            .map(|(joint, normal)| match (joint.kind, planar) {
                (JointKind::Revolute, _) => onto(&joint.axis),
                (JointKind::Prismatic, true) => onto(normal),
                (JointKind::Prismatic, false) => Matrix3::identity(),
            })
            .collect();
        let links = model.joints().iter().zip(&aligned).map(|(joint, own)| {
            let parent = joint.parent.map_or(base_axes, |p| aligned[p]).transpose();
            let fixed = parent * joint.placement.rotation * own;
            Link {
                parent: joint.parent,
                kind: joint.kind,
                fixed: [0, 1, 2].map(|i| fixed.column(i).into_owned().into()),
                offset: (parent * joint.placement.translation).into(),
                slide: (own.transpose() * joint.axis.as_ref()).into(),
            }
        });
        let bodies = std::iter::once((&model.base().inertia, &base_axes)).chain(
            model
                .joints()
                .iter()
                .map(|joint| &joint.body.inertia)
                .zip(&aligned),
        );
        Self {
            masses: bodies
                .map(|(body, axes)| mass(body, &axes.transpose()))
                .collect(),
            links: links.collect(),
            planar,
        }
    }
}

/// Rotation that takes z to `axis`.
fn onto(axis: &Vector3<f64>) -> Matrix3<f64> {
    Rotation3::rotation_between(&Vector3::z(), axis)
        .unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI))
        .into_inner()
}

/// The plane's normal in the frame of every joint; of no meaning in space.
fn normals(model: &Model) -> Vec<Vector3<f64>> {
    let normal = model
        .plane()
        .map_or(Vector3::z(), |plane| plane.basis.column(2).into_owned());
    let mut found: Vec<Vector3<f64>> = Vec::new();
    for joint in model.joints() {
        let of_parent = joint.parent.map_or(normal, |p| found[p]);
        found.push(joint.placement.rotation.transpose() * of_parent);
    }
    found
}

fn mass(body: &Inertia, turn: &Matrix3<f64>) -> Mass {
    let inertia = turn * body.rotational() * turn.transpose();
    Mass {
        mass: body.mass(),
        center: turn * body.center(),
        by_factor: by_factor(&inertia),
        inertia,
        turn: *turn,
    }
}

/// The parts of an inertia that belong to its principal second moments s: the moment s along the
/// unit vector v makes the inertia s(1 − v·vᵀ).
fn by_factor(inertia: &Matrix3<f64>) -> [Matrix3<f64>; 3] {
    let eigen = SymmetricEigen::new((inertia + inertia.transpose()) * 0.5);
    let half = 0.5 * eigen.eigenvalues.sum();
    [0, 1, 2].map(|k| {
        let axis = eigen.eigenvectors.column(k).into_owned();
        // Published inertias break the triangle inequality by rounding.
        let second_moment = (half - eigen.eigenvalues[k]).max(0.0);
        (Matrix3::identity() - axis * axis.transpose()) * second_moment
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_inertia_is_the_sum_of_its_parts_and_any_factors_make_a_body() {
        let turn = Rotation3::from_euler_angles(0.3, -0.8, 1.1).into_inner();
        let moments = Matrix3::from_diagonal(&Vector3::new(1.0, 2.5, 3.2));
        let inertia = turn * moments * turn.transpose();
        let parts = by_factor(&inertia);
        let sum: Matrix3<f64> = parts.iter().sum();
        assert!((sum - inertia).amax() < 1e-14);
        for factors in [[0.1, 5.0, 1.0], [3.0, 0.01, 0.01], [1.0, 1.0, 40.0]] {
            let scaled = parts[0] * factors[0] + parts[1] * factors[1] + parts[2] * factors[2];
            Inertia::new(1.0, Vector3::zeros(), scaled).unwrap();
        }
    }
}
