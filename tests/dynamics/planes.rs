//! Motion in a plane: when there is one, and that it is that in space.

use crate::compared::*;
use crate::problems::two_link;
use crate::trees;
use fastrand::Rng;
use ffsm_ipopt::dynamics::{Body, Data, Inertia, Model, Placement, Tree};
use ffsm_ipopt::nalgebra::{Matrix3, Vector3};

#[test]
fn plane_and_space_agree() {
    let rng = &mut Rng::with_seed(8);
    let mut robots = vec![two_link()];
    for normal in [
        Vector3::z(),
        Vector3::y(),
        Vector3::x(),
        Vector3::new(0.3, 0.5, -1.0).normalize(),
    ] {
        robots.push(trees::planar(rng, normal));
    }
    for model in robots {
        let n = model.joint_count();
        let plane = Tree::planar(&model).expect("planar");
        let space = Tree::spatial(&model);
        let basis = model.plane().unwrap().basis;
        for _ in 0..30 {
            let (q, dq) = (trees::values(rng, n, 3.0), trees::values(rng, n, 2.0));
            let (flat, full) = (evaluate(&plane, &q, &dq), evaluate(&space, &q, &dq));
            let omega = basis.transpose() * full.base_rate;
            let scale = omega.norm();
            assert_close("ω", flat.base_rate.x, omega.z, scale, 1e-12);
            assert_close("ω in the plane", omega.xy().norm(), 0.0, scale, 1e-12);
            let center = basis.transpose() * full.system_center;
            let scale = center.norm();
            assert_close(
                "mass centre",
                (flat.system_center - center.xy()).norm(),
                0.0,
                scale,
                1e-12,
            );
            let (a, b) = (inertia_matrix(&flat, n), inertia_matrix(&full, n));
            assert!((&a - &b).amax() < 1e-12 * b.amax(), "H differs");
            let scale = full.bias.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
            for (a, b) in flat.bias.iter().zip(&full.bias) {
                assert_close("Cθ̇", *a, *b, scale, 1e-12);
            }
        }
    }
}

/// Table I with the second link's body replaced.
fn with_second_link(center: Vector3<f64>, rotational: Matrix3<f64>) -> Model {
    let robot = two_link();
    let mut joints = robot.joints().to_vec();
    let name = "link".into();
    joints[1].body = Body {
        name,
        inertia: Inertia::new(1.2, center, rotational).unwrap(),
    };
    Model::new("changed", robot.base().clone(), joints).unwrap()
}

#[test]
fn a_plane_needs_more_than_parallel_axes() {
    let round = Matrix3::identity() * 0.0486;
    assert!(
        with_second_link(Vector3::new(0.35, 0.0, 0.0), round)
            .plane()
            .is_some()
    );
    assert!(
        with_second_link(Vector3::new(0.35, 0.0, 0.01), round)
            .plane()
            .is_none()
    );

    let mut product = round;
    product[(0, 1)] = 0.004;
    product[(1, 0)] = 0.004;
    assert!(
        with_second_link(Vector3::new(0.35, 0.0, 0.0), product)
            .plane()
            .is_some()
    );
    let mut product = round;
    product[(0, 2)] = 0.004;
    product[(2, 0)] = 0.004;
    assert!(
        with_second_link(Vector3::new(0.35, 0.0, 0.0), product)
            .plane()
            .is_none()
    );
    // What would be lost: this robot's base tips out of the plane.
    let tilted = with_second_link(Vector3::new(0.35, 0.0, 0.01), round);
    let omega = evaluate(&Tree::spatial(&tilted), &[0.3, -0.8], &[1.0, 0.5]).base_rate;
    assert!(omega.xy().norm() > 1e-4);

    assert!(two_link().in_space().plane().is_none());
    for model in trees::zoo(3) {
        assert!(model.plane().is_none());
    }
}

#[test]
fn a_plane_may_have_any_normal() {
    let rng = &mut Rng::with_seed(9);
    for normal in [
        Vector3::y(),
        Vector3::x(),
        Vector3::new(1.0, 2.0, -3.0).normalize(),
    ] {
        let plane = trees::planar(rng, normal).plane().expect("planar").clone();
        assert!(plane.basis.column(2).cross(&normal).norm() < 1e-12);
        assert!((plane.basis.determinant() - 1.0).abs() < 1e-12);
    }
}

/// Distance of two points, across the plane included, in the plane and in space.
#[test]
fn heights_above_the_plane_are_kept() {
    let rng = &mut Rng::with_seed(37);
    let model = trees::planar(rng, Vector3::new(0.3, -0.5, 0.8));
    let (flat, solid) = (Tree::planar(&model).unwrap(), Tree::spatial(&model));
    let n = model.joint_count();
    let q = trees::values(rng, n, 1.0);
    let mut in_plane = Data::new(&flat);
    flat.kinematics(&q, &mut in_plane);
    let mut in_space = Data::new(&solid);
    solid.kinematics(&q, &mut in_space);
    for (a, b) in (0..n).flat_map(|a| (0..a).map(move |b| (Some(a), b.checked_sub(1)))) {
        let mut at = || Placement {
            rotation: trees::rotation(rng),
            translation: trees::vector(rng),
        };
        let (first, second) = (at(), at());
        let [p, o] = [(a, &first), (b, &second)].map(|(link, at)| flat.mount(link, at));
        let height = flat.height_between(&p, &o);
        let found = flat
            .relative_position(&p, &o, &in_plane)
            .norm()
            .hypot(height);
        let [p, o] = [(a, &first), (b, &second)].map(|(link, at)| solid.mount(link, at));
        assert_eq!(solid.height_between(&p, &o), 0.0);
        let expected = solid.relative_position(&p, &o, &in_space).norm();
        assert_close("distance", found, expected, 1.0, 1e-12);
    }
}
