//! How the time of one solver iteration grows with joints and with collocation points.
//!
//! Prints a table and the exponents of power laws fitted to it, which criterion does not.

#[path = "../tests/trees/mod.rs"]
mod trees;

use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::nlp::{self, Control, Statistics};
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::refine::{Refinement, Settings, Start};
use ffsm_ipopt::system::FreeFloating;
use ffsm_ipopt::transcription::{Discretization, Patterns};

/// Iterations timed: enough to average, few enough for the largest arm.
const ITERATIONS: u32 = 4;

/// A rest-to-rest motion of a chain of `n` random joints.
fn chain(n: usize) -> Problem {
    let goal: Vec<f64> = (0..n).map(|j| 0.3 / (1.0 + j as f64)).collect();
    let mut problem = Problem::builder("chain", trees::chain(n, 5), 10.0, &vec![0.0; n], &goal);
    problem.cost.base_rate = vec![1.0; 3];
    problem.cost.joint_rate = vec![0.1; n];
    problem.cost.control = vec![0.1; n];
    problem.build().expect("a valid problem")
}

/// Milliseconds an iteration in derivatives, in linear systems and in all.
fn iteration(problem: &Problem, mesh: Mesh) -> [f64; 3] {
    let n = problem.robot.joint_count();
    let system = FreeFloating::spatial(problem);
    let settings = Settings {
        max_iterations: Some(1),
        ..Settings::default()
    };
    let mut solver = nlp::Settings::default();
    solver.max_iterations = ITERATIONS;
    let patterns = Patterns::detect(&system);
    let refinement = Refinement {
        ocp: &system,
        patterns: &patterns,
        settings: &settings,
        solver: &solver,
    };
    let goal = &problem.task.final_joints;
    let trajectory = Discretization::sample(mesh, 10.0, 3 + 2 * n, n, |part, x, _| {
        x.iter_mut()
            .skip(3)
            .zip(goal)
            .for_each(|(x, goal)| *x = part * goal);
    });
    let start = Start {
        trajectory,
        iterate: None,
    };
    let Statistics {
        iterations,
        derivatives,
        linear_solver,
        total,
        ..
    } = refinement
        .run(&start, &mut |_| Control::Continue)
        .expect("a programme that Ipopt takes")
        .statistics;
    [derivatives, linear_solver, total]
        .map(|time| time.as_secs_f64() * 1e3 / f64::from(iterations.max(1)))
}

/// Exponent of the power law through (size, time) by least squares of the logarithms.
fn exponent(sizes: &[usize], times: &[f64]) -> f64 {
    let points: Vec<(f64, f64)> = sizes
        .iter()
        .zip(times)
        .map(|(&s, t)| ((s as f64).ln(), t.max(1e-6).ln()))
        .collect();
    let count = points.len() as f64;
    let (mx, my) = points
        .iter()
        .fold((0.0, 0.0), |(a, b), (x, y)| (a + x / count, b + y / count));
    let (above, below) = points.iter().fold((0.0, 0.0), |(a, b), (x, y)| {
        (a + (x - mx) * (y - my), b + (x - mx).powi(2))
    });
    above / below
}

fn table(what: &str, sizes: &[usize], time: impl Fn(usize) -> [f64; 3]) {
    println!("\n{what:>11}  derivatives / ms  linear systems / ms  iteration / ms");
    let rows: Vec<[f64; 3]> = sizes
        .iter()
        .map(|&size| {
            let row = time(size);
            println!(
                "{size:>11}  {:>16.2}  {:>19.2}  {:>14.2}",
                row[0], row[1], row[2]
            );
            row
        })
        .collect();
    let fitted = [0, 1, 2].map(|i| exponent(sizes, &rows.iter().map(|r| r[i]).collect::<Vec<_>>()));
    println!(
        "{:>11}  {:>16.2}  {:>19.2}  {:>14.2}",
        "exponent", fitted[0], fitted[1], fitted[2]
    );
}

fn main() {
    // `cargo bench` names itself; `cargo test --benches` only wants to see it start.
    if !std::env::args().any(|argument| argument == "--bench") {
        return;
    }
    let mesh = |points: usize| Mesh::uniform(points / 4, 4).expect("a mesh");
    table("joints", &[2, 4, 7, 14, 28], |n| {
        iteration(&chain(n), mesh(20))
    });
    // A mesh as plans begin with.
    table("10×5 joints", &[7, 14, 28, 40], |n| {
        iteration(&chain(n), Mesh::uniform(10, 5).expect("a mesh"))
    });
    table("points", &[100, 200, 400, 800, 1600], |points| {
        iteration(&chain(3), mesh(points))
    });
}
