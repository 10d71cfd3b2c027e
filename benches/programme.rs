//! Time of the programme's derivatives and of one whole solve.

#[path = "../tests/problems/mod.rs"]
mod problems;
#[path = "../tests/trees/mod.rs"]
mod trees;

use criterion::{Criterion, criterion_group, criterion_main};
use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::nlp::Nlp;
use ffsm_ipopt::planner::Planner;
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::system::FreeFloating;
use ffsm_ipopt::transcription::{Patterns, Transcription};
use std::hint::black_box;

/// Jacobian and Hessian of all points of one mesh, each with everything it needs.
fn derivatives(c: &mut Criterion) {
    let problem = problems::relaxed();
    let plane = FreeFloating::planar(&problem).expect("a planar arm");
    let joints = 7;
    let arm = trees::chain(joints, 5);
    let mut spatial = Problem::builder("chain", arm, 10.0, &vec![0.0; joints], &vec![0.4; joints]);
    spatial.cost.base_rate = vec![1.0; 3];
    spatial.cost.joint_rate = vec![0.1; joints];
    let spatial = spatial.build().expect("a valid problem");
    let space = FreeFloating::spatial(&spatial);
    let mesh = || Mesh::uniform(10, 5).expect("a mesh");
    bench_derivatives(
        c,
        "two-link 10×5",
        Transcription::new(&plane, &Patterns::detect(&plane), mesh()),
    );
    bench_derivatives(
        c,
        "7 joints 10×5",
        Transcription::new(&space, &Patterns::detect(&space), mesh()),
    );
    c.bench_function("sparsity/7 joints", |b| {
        b.iter(|| Patterns::detect(black_box(&space)))
    });
}

fn bench_derivatives(c: &mut Criterion, name: &str, mut nlp: impl Nlp) {
    let size = nlp.size();
    let x: Vec<f64> = (0..size.variables)
        .map(|i| 0.1 * (i as f64).sin())
        .collect();
    let multipliers = vec![0.5; size.constraints];
    let mut group = c.benchmark_group(name);
    let mut values = vec![0.0; size.jacobian_nonzeros];
    group.bench_function("jacobian", |b| {
        b.iter(|| {
            nlp.new_point();
            nlp.jacobian(black_box(&x), &mut values)
        })
    });
    let mut values = vec![0.0; size.hessian_nonzeros];
    group.bench_function("hessian", |b| {
        b.iter(|| {
            nlp.new_point();
            nlp.hessian(black_box(&x), 1.0, &multipliers, &mut values)
        })
    });
}

/// `table1-relaxed` from the problem to the trajectory: one mesh, and refined to 1e-5.
fn plans(c: &mut Criterion) {
    let refined = problems::relaxed();
    let single = refined
        .edited(|single| single.mesh.max_iterations = Some(1))
        .expect("a valid problem");
    let mut group = c.benchmark_group("table1-relaxed");
    group.sample_size(20);
    for (name, problem) in [("one NLP, 10×5", single), ("A-RPM to 1e-5", refined)] {
        group.bench_function(name, |b| {
            b.iter(|| Planner::new().plan(black_box(&problem)).expect("a plan"))
        });
    }
}

criterion_group!(benches, derivatives, plans);
criterion_main!(benches);
