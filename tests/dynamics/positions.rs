//! Mass centre and frames by the joints, with their derivatives.

use crate::compared::*;
use crate::trees;
use fastrand::Rng;
use ffsm_ipopt::autodiff::HyperDual;
use ffsm_ipopt::dynamics::space::{Space, Vector};
use ffsm_ipopt::dynamics::{Data, Placement, Tree};

/// Derivatives of the mass centre by every pair of joints against hyper-dual numbers.
fn check_center_derivatives<Sp: Space>(tree: &Tree<Sp>, rng: &mut Rng) {
    let n = tree.joint_count();
    let (q, dq) = (trees::values(rng, n, 3.0), vec![0.0; n]);
    let data = evaluate(tree, &q, &dq);
    let mut seeded = Data::<Sp, HyperDual<1, 1>>::new(tree);
    let close = |what: &str, found: &Sp::Linear<f64>, expected: Vec<f64>| {
        assert_eq!(expected.len(), Sp::LENGTHS);
        for (found, expected) in found.components().iter().zip(expected) {
            assert_close(what, *found, expected, 1.0, 1e-14);
        }
    };
    for k in 0..n {
        for l in 0..n {
            let position = |(i, &value): (usize, &f64)| {
                HyperDual::seeded(value, (i == k).then_some(0), (i == l).then_some(0))
            };
            let moving: Vec<_> = q.iter().enumerate().map(position).collect();
            tree.kinematics(&moving, &mut seeded);
            tree.momentum(&mut seeded);
            let center = seeded.system_center.components();
            let by = center.iter().map(|c| c.rows[0]).collect();
            close("by one joint", &tree.system_center_by(&data, k), by);
            let both = center.iter().map(|c| c.block[0][0]).collect();
            let found = tree.system_center_by_both(&data, k, l);
            close("by two joints", &found, both);
        }
    }
}

#[test]
fn the_mass_centre_moves_with_the_joints() {
    let rng = &mut Rng::with_seed(14);
    for model in robots() {
        check_center_derivatives(&Tree::spatial(&model), rng);
        if let Some(tree) = Tree::planar(&model) {
            check_center_derivatives(&tree, rng);
        }
    }
}

/// The point `mount` as seen from `other` and its derivatives, by formula and by hyper-dual numbers.
fn check_relative_position<Sp: Space>(tree: &Tree<Sp>, links: [Option<usize>; 2], rng: &mut Rng) {
    type Second = HyperDual<1, 1>;
    let n = tree.joint_count();
    let [mount, other] = links.map(|link| {
        let placement = Placement {
            rotation: trees::rotation(rng),
            translation: trees::vector(rng),
        };
        tree.mount(link, &placement)
    });
    let q = trees::values(rng, n, 1.5);
    let mut data = Data::<Sp, f64>::new(tree);
    tree.kinematics(&q, &mut data);
    let mut dual = Data::<Sp, Second>::new(tree);
    let moving = tree.joints_between(&mount, &other);
    for k in 0..n {
        let by_k = tree.relative_position_by(&mount, &other, &data, k);
        let still = by_k.components().iter().all(|c| *c == 0.0);
        assert!(still || moving.contains(&k), "joint {k}");
        for l in 0..n {
            let seeded: Vec<Second> = (0..n)
                .map(|j| Second::seeded(q[j], (j == k).then_some(0), (j == l).then_some(0)))
                .collect();
            tree.kinematics(&seeded, &mut dual);
            let expected = tree.relative_position(&mount, &other, &dual);
            let by_both = tree.relative_position_by_both(&mount, &other, &data, k, l);
            for (i, expected) in expected.components().iter().enumerate() {
                for (found, expected) in [
                    (by_k.components()[i], expected.rows[0]),
                    (by_both.components()[i], expected.block[0][0]),
                ] {
                    assert_close("derivative", found, expected, 1.0, 1e-13);
                }
            }
        }
    }
}

#[test]
fn relative_positions_and_their_derivatives() {
    let rng = &mut Rng::with_seed(31);
    for model in robots() {
        let n = model.joint_count();
        let mut link = || rng.usize(0..=n).checked_sub(1);
        let pairs: Vec<_> = (0..6).map(|_| [link(), link()]).collect();
        for links in pairs {
            if let Some(tree) = Tree::planar(&model) {
                check_relative_position(&tree, links, rng);
            }
            check_relative_position(&Tree::spatial(&model), links, rng);
        }
    }
}
