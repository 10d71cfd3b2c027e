//! Massless joints: those that move without moving any mass, where bodies lack mass or size.
//!
//! Derived in docs/algorithms.md#massless-bodies.

use super::algebra::Spatial;
use super::{Body, Data, Joint, Tree};

/// Pivots of H below this, relative to what a joint moves, are rounding errors.
const TOLERANCE: f64 = 1e-12;
/// Joint positions at which a robot is tried: one of them alone may be singular by chance.
const TRIALS: u64 = 3;

/// The first joint that, with those before it, moves no mass at joint positions `q`.
pub(super) fn at(base: &Body, joints: &[Joint], q: &[f64]) -> Option<usize> {
    if all_solid(joints) {
        return None;
    }
    first(&Tree::in_space(base, joints), q)
}

/// The first joint that does so at all joint positions.
pub(super) fn always(base: &Body, joints: &[Joint]) -> Option<usize> {
    if all_solid(joints) {
        return None;
    }
    let tree = Tree::in_space(base, joints);
    let mut massless = None;
    for trial in 0..TRIALS {
        let mut rng = fastrand::Rng::with_seed(trial);
        let q: Vec<f64> = joints.iter().map(|_| rng.f64() + 0.1).collect();
        massless = Some(first(&tree, &q)?);
    }
    massless
}

/// Whether every joint moves mass whatever the others do.
fn all_solid(joints: &[Joint]) -> bool {
    joints.iter().all(|joint| joint.body.inertia.is_solid())
}

/// Factors H as LDLᵀ up to the first pivot that vanishes.
fn first(tree: &Tree<Spatial>, q: &[f64]) -> Option<usize> {
    let n = tree.joint_count();
    let mut data = Data::<Spatial, f64>::new(tree);
    tree.kinematics(q, &mut data);
    tree.momentum(&mut data);
    tree.mass_matrix(&mut data);
    let extent = (data.joints.iter())
        .flat_map(|joint| [joint.origin, joint.center])
        .map(|r| r.dot(&r))
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
