//! Finds joints that move without moving any mass, where bodies lack mass or size.

use super::space::Spatial;
use super::{Data, Model, Tree};

/// Pivots of H below this, relative to what a joint moves, are rounding errors.
const TOLERANCE: f64 = 1e-12;
/// Joint positions at which a robot is tried: one of them alone may be singular by chance.
const TRIALS: u64 = 3;

/// The first joint that, with those before it, moves no mass at joint positions `q`.
pub(super) fn at(model: &Model, q: &[f64]) -> Option<usize> {
    if model.joints().iter().all(|j| j.body.inertia.is_solid()) {
        return None;
    }
    first_inert(&Tree::spatial(model), q)
}

/// The first joint that does so at all joint positions.
pub(super) fn always(model: &Model) -> Option<usize> {
    if model.joints().iter().all(|j| j.body.inertia.is_solid()) {
        return None;
    }
    let tree = Tree::spatial(model);
    let mut inert = None;
    for trial in 0..TRIALS {
        let mut rng = fastrand::Rng::with_seed(trial);
        let q: Vec<f64> = model.joints().iter().map(|_| rng.f64() + 0.1).collect();
        inert = Some(first_inert(&tree, &q)?);
    }
    inert
}

/// Factors H as LDLᵀ up to the first pivot that vanishes.
fn first_inert(tree: &Tree<Spatial>, q: &[f64]) -> Option<usize> {
    let n = tree.joint_count();
    let mut data = Data::<Spatial, f64>::new(tree);
    tree.kinematics(q, &mut data);
    tree.momentum(&mut data);
    tree.mass_matrix(&mut data);
    let extent = data
        .origin
        .iter()
        .chain(&data.center)
        .map(|r| r.dot(r))
        .fold(0.0, f64::max);
    let mut lower = vec![0.0; n * n];
    let mut pivots: Vec<f64> = Vec::with_capacity(n);
    for i in 0..n {
        for j in 0..i {
            let known: f64 = (0..j)
                .map(|k| lower[i * n + k] * lower[j * n + k] * pivots[k])
                .sum();
            lower[i * n + j] = (data.mass_matrix[i * n + j] - known) / pivots[j];
        }
        let own = data.mass_matrix[i * n + i];
        let known: f64 = (0..i).map(|k| lower[i * n + k].powi(2) * pivots[k]).sum();
        if own - known <= TOLERANCE * (own + tree.links[i].carried * extent) {
            return Some(i);
        }
        pivots.push(own - known);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::{Body, Inertia, Joint, JointKind, JointLimits, ModelError, Placement};
    use super::*;
    use nalgebra::{Matrix3, Unit, Vector3};

    fn body(name: &str, inertia: Inertia) -> Body {
        Body {
            name: name.into(),
            inertia,
        }
    }

    fn solid(mass: f64) -> Inertia {
        Inertia::new(mass, Vector3::new(0.1, 0.0, 0.0), Matrix3::identity()).unwrap()
    }

    /// A chain with the given axes and bodies, joints half a metre apart along x.
    fn chain(links: Vec<(Vector3<f64>, Inertia)>) -> Result<Model, ModelError> {
        let joint = |(j, (axis, inertia)): (usize, (Vector3<f64>, Inertia))| Joint {
            name: format!("joint{j}"),
            kind: JointKind::Revolute,
            parent: j.checked_sub(1),
            placement: Placement::from_xyz_rpy(
                [if j == 0 { 0.5 } else { 0.0 }, 0.0, 0.0],
                [0.0; 3],
            ),
            axis: Unit::new_normalize(axis),
            limits: JointLimits::NONE,
            body: body(&format!("link{j}"), inertia),
        };
        let joints = links.into_iter().enumerate().map(joint).collect();
        Model::new("chain", body("base", solid(50.0)), joints)
    }

    fn inert(result: Result<Model, ModelError>) -> String {
        match result {
            Err(ModelError::Inert { joint, .. }) => joint,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn massless_bodies_are_fine_between_joints_and_nowhere_else() {
        let none = Inertia::massless;
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        assert!(chain(vec![(z, none()), (y, none()), (x, solid(1.0))]).is_ok());
        assert_eq!(inert(chain(vec![(z, solid(1.0)), (y, none())])), "joint1");
        assert_eq!(inert(chain(vec![(z, none()), (y, none())])), "joint0");
        // Two joints of one axis, nothing between them.
        assert_eq!(inert(chain(vec![(z, none()), (z, solid(1.0))])), "joint1");
    }

    #[test]
    fn a_point_mass_is_moved_by_its_arm_and_not_by_its_own_axis() {
        let point = Inertia::part(1.0, Vector3::new(0.2, 0.0, 0.0), Matrix3::zeros()).unwrap();
        assert!(chain(vec![(Vector3::z(), point.clone())]).is_ok());
        assert_eq!(inert(chain(vec![(Vector3::x(), point)])), "joint0");
    }

    #[test]
    fn a_wrist_of_massless_bodies_is_singular_where_two_axes_meet() {
        let none = Inertia::massless;
        let (y, z) = (Vector3::y(), Vector3::z());
        let model = chain(vec![(z, none()), (y, none()), (z, solid(1.0))]).unwrap();
        assert_eq!(model.inert_joint(&[0.3, 0.0, 0.2]), Some(2));
        assert_eq!(model.inert_joint(&[0.3, 0.4, 0.2]), None);
    }

    #[test]
    fn a_base_needs_inertia() {
        let base = body("base", Inertia::massless());
        let joints = chain(vec![(Vector3::z(), solid(1.0))])
            .unwrap()
            .joints()
            .to_vec();
        let error = Model::new("r", base, joints).unwrap_err();
        assert!(error.to_string().contains("'base' has no mass"), "{error}");
    }
}
