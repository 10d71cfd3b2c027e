//! Time of one collocation point: values, Jacobian and Hessian of the shipped problems.
//!
//! As in a solve, the Jacobian is of a point other than the last, and the Hessian takes up what the
//! Jacobian of its point has kept.
//!
//! With `--point FILE`, the point and the weights are read from standard input and one line of JSON
//! is printed, for the comparison with CasADi (`make casadi`).

use ffsm_ipopt::autodiff::has_fused;
use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::ocp::{Ocp, Point};
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::system::FreeFloating;
use std::hint::black_box;
use std::io::Read;
use std::path::Path;
use std::time::Instant;

/// Median of 101 batches of 200 runs, µs.
fn time(mut f: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..101)
        .map(|_| {
            let start = Instant::now();
            (0..200).for_each(|_| f());
            start.elapsed().as_secs_f64() * 1e6 / 200.0
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[50]
}

struct Measured {
    values: Vec<f64>,
    jacobian: Vec<f64>,
    hessian: Vec<f64>,
    /// µs: values, Jacobian, Hessian.
    times: [f64; 3],
}

fn measure<O: Ocp>(ocp: &O, point: impl FnOnce(usize, usize) -> (Vec<f64>, Vec<f64>)) -> Measured {
    let formulation = ocp.formulation();
    let (n, m) = formulation.widths();
    let path = formulation.path.len();
    let (inputs, outputs) = (n + m + 1, n + path + 1);
    let (z, weights) = point(n + m, outputs);
    let (x, u) = z.split_at(n);
    let at = Point {
        x,
        u,
        parameters: &[],
        t: 0.0,
    };
    // Two points in turn: at the same one nothing would be left to do.
    let moved: Vec<f64> = x.iter().map(|x| x + 1e-3).collect();
    let elsewhere = Point { x: &moved, ..at };
    let mut own = ocp.derivatives().expect("derivatives by structure");
    let mut scratch = ocp.scratch::<f64>();
    let mut values = vec![0.0; outputs];
    let mut jacobian = vec![0.0; outputs * inputs];
    let mut hessian = vec![0.0; inputs * inputs];
    let points = [at, elsewhere];
    let mut kept = [(); 2].map(|()| vec![0.0; own.kept()]);
    let mut k = 0;
    let times = [
        time(|| {
            let (rates, rest) = values.split_at_mut(n);
            let (rows, cost) = rest.split_at_mut(path);
            cost[0] = ocp.continuous(black_box(at), &mut scratch, rates, rows);
        }),
        time(|| {
            k = 1 - k;
            own.jacobian(black_box(points[k]), &mut jacobian);
            own.keep(&mut kept[k]);
        }),
        time(|| {
            k = 1 - k;
            own.recall(&kept[k]);
            own.hessian(black_box(points[k]), &weights, &mut hessian);
        }),
    ];
    own.jacobian(at, &mut jacobian);
    own.hessian(at, &weights, &mut hessian);
    // The time is no input elsewhere.
    let without_time = |dense: &[f64], rows: usize| -> Vec<f64> {
        let rows = dense.chunks_exact(inputs).take(rows);
        rows.flat_map(|row| row[..n + m].to_vec()).collect()
    };
    Measured {
        values,
        jacobian: without_time(&jacobian, outputs),
        hessian: without_time(&hessian, n + m),
        times,
    }
}

fn of(problem: &Problem, point: impl FnOnce(usize, usize) -> (Vec<f64>, Vec<f64>)) -> Measured {
    match FreeFloating::planar(problem) {
        Some(system) => measure(&system, point),
        None => measure(&FreeFloating::spatial(problem), point),
    }
}

fn load(file: &str) -> Problem {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    ProblemFile::load(&file, &Overrides::default())
        .expect("a problem file")
        .problem
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    if let Some(k) = arguments.iter().position(|a| a == "--point") {
        let mut text = String::new();
        std::io::stdin().read_to_string(&mut text).expect("a point");
        let numbers = text
            .split_whitespace()
            .map(|n| n.parse().expect("a number"));
        let numbers: Vec<f64> = numbers.collect();
        let measured = of(&load(&arguments[k + 1]), |inputs, outputs| {
            let (z, weights) = numbers.split_at(inputs);
            assert_eq!(weights.len(), outputs, "a weight for each output");
            (z.to_vec(), weights.to_vec())
        });
        let [values, jacobian, hessian] = measured.times;
        let json = serde_json::json!({
            "values": measured.values,
            "jacobian": measured.jacobian,
            "hessian": measured.hessian,
            "time": { "values": values, "jacobian": jacobian, "hessian": hessian },
        });
        println!("{json}");
        return;
    }
    let vectors = if has_fused() {
        "wide vectors with fused multiply-add"
    } else {
        "plain vectors"
    };
    println!("one collocation point, {vectors}; median µs");
    println!(
        "{:<16}{:>10}{:>10}{:>10}",
        "problem", "values", "Jacobian", "Hessian"
    );
    for name in ["table1-relaxed", "planar-3link", "chaser-7dof", "dual-arm"] {
        let measured = of(&load(&format!("config/{name}.toml")), |inputs, outputs| {
            let wave = |count: usize, step: f64| -> Vec<f64> {
                (0..count)
                    .map(|k| 0.4 * (1.0 + step * k as f64).sin())
                    .collect()
            };
            (wave(inputs, 0.7), wave(outputs, 1.1))
        });
        let [values, jacobian, hessian] = measured.times;
        println!("{name:<16}{values:>10.3}{jacobian:>10.3}{hessian:>10.3}");
    }
}
