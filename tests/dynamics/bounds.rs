//! Bounds that hold at all joint positions.

use crate::compared::*;
use crate::problems::two_link;
use crate::trees;
use fastrand::Rng;
use ffsm_ipopt::dynamics::space::{Space, Vector};
use ffsm_ipopt::dynamics::{Model, Placement, Tree};
use ffsm_ipopt::nalgebra::DVector;

/// Bounds on H and on the distance of a frame in the last body, held at random positions.
fn assert_bounded<Sp: Space>(tree: &Tree<Sp>, rng: &mut Rng) -> usize {
    let n = tree.joint_count();
    let ranges = vec![[-3.0, 2.0]; n];
    let mobility: Vec<Option<f64>> = (0..n)
        .map(|j| tree.largest_mobility(j, ranges[j]))
        .collect();
    let mount = tree.mount(
        Some(n - 1),
        &Placement::from_xyz_rpy([0.3, -0.2, 0.1], [0.0; 3]),
    );
    let travel = vec![3.0; n];
    let ball = tree.reach_from_base(&mount, &travel);
    let reach = tree.reach_from_center(&mount, &travel);
    let length = |v: Sp::Linear<f64>| v.dot(&v).sqrt();
    for _ in 0..200 {
        let q: Vec<f64> = (0..n).map(|_| -3.0 + 5.0 * rng.f64()).collect();
        let dq = trees::values(rng, n, 1.0);
        let data = evaluate(tree, &q, &dq);
        let h = inertia_matrix(&data, n);
        let rates = DVector::from_vec(dq.clone());
        let sizes: Vec<f64> = dq.iter().map(|rate| rate.abs()).collect();
        let energy = (h.clone() * &rates).dot(&rates);
        let most = tree.largest_energy(&sizes, &ranges);
        assert!(energy <= most * (1.0 + 1e-9), "{energy} above {most}");
        let inverse = h.try_inverse().expect("H is regular");
        for (j, mobility) in mobility.iter().enumerate() {
            let most = mobility.unwrap_or(f64::INFINITY);
            let found = inverse[(j, j)];
            assert!(found <= most * (1.0 + 1e-9), "{j}: {found} above {most}");
        }
        let at = tree.position(&mount, &data);
        assert!(length(at - ball.center) <= ball.radius * (1.0 + 1e-9));
        assert!(length(at - data.system_center) <= reach * (1.0 + 1e-9));
    }
    mobility.iter().flatten().count()
}

#[test]
fn no_position_exceeds_the_bounds_on_inertia_and_reach() {
    let rng = &mut Rng::with_seed(11);
    let mut known = 0;
    for robot in robots() {
        known += assert_bounded(&Tree::spatial(&robot), rng);
        if let Some(tree) = Tree::planar(&robot) {
            known += assert_bounded(&tree, rng);
        }
    }
    assert!(known > 100, "{known} bounds");
}

#[test]
fn bounds_on_one_joint_are_its_extremes() {
    let joints = two_link().joints()[..1].to_vec();
    let model = Model::new("one", two_link().base().clone(), joints).unwrap();
    let tree = Tree::planar(&model).unwrap();
    let range = [-1.5, 1.5];
    let inertia = (0..=1000).map(|k| {
        let q = -1.5 + 0.003 * f64::from(k);
        evaluate(&tree, &[q], &[0.0]).mass_matrix[0]
    });
    let (least, most) = inertia.fold((f64::INFINITY, 0.0_f64), |(least, most), h| {
        (least.min(h), most.max(h))
    });
    let mobility = tree.largest_mobility(0, range).unwrap();
    assert_close("mobility", mobility, 1.0 / least, mobility, 2e-3);
    let energy = tree.largest_energy(&[2.0], &[range]);
    assert_close("energy", energy, 4.0 * most, energy, 2e-3);
}
