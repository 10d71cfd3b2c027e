//! Time of the free-floating dynamics alone, by joints and by number type.

#[path = "../tests/problems/mod.rs"]
mod problems;
#[path = "../tests/trees/mod.rs"]
mod trees;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use ffsm_ipopt::autodiff::{Dual, HyperDual, Scalar};
use ffsm_ipopt::dynamics::space::{Planar, Space, Spatial};
use ffsm_ipopt::dynamics::{Data, Tree};
use std::hint::black_box;

/// Base rate, H, Cθ̇ and H⁻¹Cθ̇ at one configuration.
fn evaluate<Sp: Space, S: Scalar>(tree: &Tree<Sp>, data: &mut Data<Sp, S>, q: &[S], dq: &[S]) -> S {
    tree.kinematics(q, data);
    tree.momentum(data);
    tree.base_rate(dq, data);
    tree.mass_matrix(data);
    tree.bias(dq, data);
    data.factors.factor(&data.mass_matrix);
    let mut bias = std::mem::take(&mut data.bias);
    data.factors.solve(&mut bias);
    data.bias = bias;
    data.bias[0]
}

fn bench<Sp: Space, S: Scalar>(c: &mut Criterion, group: &str, tree: &Tree<Sp>) {
    let n = tree.joint_count();
    let mut data = Data::<Sp, S>::new(tree);
    let q: Vec<S> = (0..n).map(|j| S::constant(0.3 + 0.1 * j as f64)).collect();
    let dq: Vec<S> = (0..n).map(|j| S::constant(0.2 - 0.05 * j as f64)).collect();
    c.benchmark_group(group)
        .bench_function(BenchmarkId::from_parameter(n), |b| {
            b.iter(|| evaluate(tree, &mut data, black_box(&q), black_box(&dq)))
        });
}

fn dynamics(c: &mut Criterion) {
    let plane = Tree::<Planar>::planar(&problems::two_link()).expect("a planar arm");
    bench::<Planar, f64>(c, "dynamics/plane/value", &plane);
    bench::<Planar, Dual<8>>(c, "dynamics/plane/dual 8", &plane);
    bench::<Planar, HyperDual<4, 4>>(c, "dynamics/plane/hyper-dual 4×4", &plane);
    for n in [2, 4, 7, 14] {
        let space = Tree::<Spatial>::spatial(&trees::chain(n, 5));
        bench::<Spatial, f64>(c, "dynamics/space/value", &space);
        bench::<Spatial, Dual<8>>(c, "dynamics/space/dual 8", &space);
        bench::<Spatial, HyperDual<4, 4>>(c, "dynamics/space/hyper-dual 4×4", &space);
    }
}

criterion_group!(benches, dynamics);
criterion_main!(benches);
