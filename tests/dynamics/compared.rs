//! What is compared, and how.

use crate::problems::two_link;
use crate::trees;
use fastrand::Rng;
use ffsm_ipopt::dynamics::space::{Space, Vector};
use ffsm_ipopt::dynamics::{Data, Model, Tree};
use ffsm_ipopt::nalgebra::{DMatrix, Vector3};

pub fn evaluate<Sp: Space>(tree: &Tree<Sp>, q: &[f64], dq: &[f64]) -> Data<Sp, f64> {
    let mut data = Data::new(tree);
    tree.kinematics(q, &mut data);
    tree.momentum(&mut data);
    tree.base_rate(dq, &mut data);
    tree.mass_matrix(&mut data);
    tree.bias(dq, &mut data);
    data
}

/// H as a full matrix.
pub fn inertia_matrix<Sp: Space>(data: &Data<Sp, f64>, n: usize) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |i, j| data.mass_matrix[i.max(j) * n + i.min(j)])
}

pub fn assert_close(what: &str, found: f64, expected: f64, scale: f64, tolerance: f64) {
    let gap = (found - expected).abs() / scale;
    assert!(
        gap <= tolerance,
        "{what}: {found:e} instead of {expected:e}, relative gap {gap:.1e}"
    );
}

pub fn robots() -> Vec<Model> {
    let rng = &mut Rng::with_seed(7);
    let mut robots: Vec<Model> = (10..14).flat_map(trees::zoo).collect();
    robots.push(two_link());
    robots.push(two_link().in_space());
    robots.push(trees::planar(rng, Vector3::y()));
    robots
}

/// H and Cθ̇ by whichever form the robot has.
pub fn reduced(model: &Model, q: &[f64], dq: &[f64]) -> (DMatrix<f64>, Vec<f64>, Vec<f64>) {
    let n = model.joint_count();
    match Tree::planar(model) {
        Some(tree) => {
            let data = evaluate(&tree, q, dq);
            (
                inertia_matrix(&data, n),
                data.bias.clone(),
                data.base_rate.components().to_vec(),
            )
        }
        None => {
            let data = evaluate(&Tree::spatial(model), q, dq);
            (
                inertia_matrix(&data, n),
                data.bias.clone(),
                data.base_rate.components().to_vec(),
            )
        }
    }
}
