//! The multifrontal linear solver on the systems of whole solves, beside MUMPS where
//! `scripts/bench-kkt.sh` has built a way to call it.
//!
//! Every system of a solve, and the same shifted as Ipopt shifts for wrong inertia, is factorised
//! and solved some times by one and then by the other: a solve uses one of them alone, and neither
//! is to find its memory evicted by the other. Printed are medians over the repetitions, averaged
//! over the systems. MUMPS is set up as Ipopt sets it up, with the ordering that is its best here.

#![expect(unsafe_code, reason = "MUMPS is called through a shared library")]

mod machine;

use ffsm_ipopt::config::ProblemFile;
use ffsm_ipopt::nlp::ipopt::{KktSystem, record};
use ffsm_ipopt::nlp::kkt::{Factors, Symbolic};
use ffsm_ipopt::parallel;
use ffsm_ipopt::planner::Planner;
use libloading::{Library, Symbol};
use machine::{bandwidth, peak};
use std::ffi::{c_int, c_void};
use std::hint::black_box;
use std::time::Instant;

/// Repetitions of each system.
const REPETITIONS: usize = 15;

type New = unsafe extern "C" fn(c_int, c_int, *mut c_int, *mut c_int, c_int) -> *mut c_void;
type WithNumbers = unsafe extern "C" fn(*mut c_void, *mut f64) -> c_int;
type Free = unsafe extern "C" fn(*mut c_void);

/// MUMPS for one pattern.
struct Mumps<'a> {
    library: &'a Library,
    handle: *mut c_void,
    rows: Vec<c_int>,
    columns: Vec<c_int>,
}

impl<'a> Mumps<'a> {
    fn new(library: &'a Library, symbolic: &Symbolic) -> Self {
        let entries = || symbolic.pattern().entries();
        let mut mumps = Self {
            library,
            handle: std::ptr::null_mut(),
            rows: entries().map(|(row, _)| row as c_int + 1).collect(),
            columns: entries().map(|(_, column)| column as c_int + 1).collect(),
        };
        // SAFETY: the function has this signature; both lists live as long as the handle.
        mumps.handle = unsafe {
            let new: Symbol<'_, New> = library.get(b"mumps_new").expect("the shim");
            new(
                symbolic.len() as c_int,
                mumps.rows.len() as c_int,
                mumps.rows.as_mut_ptr(),
                mumps.columns.as_mut_ptr(),
                0,
            )
        };
        mumps
    }

    fn call(&self, function: &[u8], numbers: &mut [f64]) -> c_int {
        // SAFETY: the functions have this signature and take as many numbers as the pattern has
        // entries, or unknowns.
        unsafe {
            let call: Symbol<'_, WithNumbers> = self.library.get(function).expect("the shim");
            call(self.handle, numbers.as_mut_ptr())
        }
    }
}

impl Drop for Mumps<'_> {
    fn drop(&mut self) {
        // SAFETY: the handle is valid and not used again.
        unsafe {
            let free: Symbol<'_, Free> = self.library.get(b"mumps_free").expect("the shim");
            free(self.handle);
        }
    }
}

/// Microseconds of analysis, factorisation and solution; the largest scaled residual.
#[derive(Default)]
struct Times {
    analyse: f64,
    factor: f64,
    solve: f64,
    residual: f64,
    /// Systems whose inertia is not what Ipopt's perturbation is to bring about.
    wrong: usize,
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_unstable_by(f64::total_cmp);
    times[times.len() / 2]
}

fn timed<T>(times: &mut Vec<f64>, body: impl FnOnce() -> T) -> T {
    let begin = Instant::now();
    let result = body();
    times.push(begin.elapsed().as_secs_f64() * 1e6);
    result
}

/// ‖b − Ax‖ over ‖A‖‖x‖ + ‖b‖, largest entries, after one step of refinement.
fn residual(symbolic: &Symbolic, values: &[f64], x: &[f64], b: &[f64]) -> (f64, Vec<f64>) {
    let mut r = b.to_vec();
    let mut rows = vec![0.0; b.len()];
    for ((i, j), value) in symbolic.pattern().entries().zip(values) {
        r[i] -= value * x[j];
        rows[i] += value.abs();
        if i != j {
            r[j] -= value * x[i];
            rows[j] += value.abs();
        }
    }
    let most = |v: &[f64]| v.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    (most(&r) / (most(&rows) * most(x) + most(b)), r)
}

/// Solves `b`, refines once, and keeps the residual.
fn accuracy(
    symbolic: &Symbolic,
    values: &[f64],
    b: &[f64],
    mut solve: impl FnMut(&mut [f64]),
) -> f64 {
    let mut x = b.to_vec();
    solve(&mut x);
    let (_, mut r) = residual(symbolic, values, &x, b);
    solve(&mut r);
    x.iter_mut().zip(&r).for_each(|(x, r)| *x += r);
    residual(symbolic, values, &x, b).0
}

/// The systems as they are, and with the diagonals of the primal part shifted.
fn shifted(systems: &[KktSystem]) -> Vec<KktSystem> {
    let mut all = systems.to_vec();
    for system in systems {
        for shift in [1e-4, 1e2] {
            let mut system = system.clone();
            let entries = system.symbolic.pattern().entries();
            let primal = entries.filter(|(i, j)| i != j).map(|(_, j)| j).max();
            let primal = primal.map_or(0, |last| last + 1);
            let pattern = system.symbolic.pattern();
            for ((i, j), value) in pattern.entries().zip(&mut system.values) {
                if i == j && i < primal {
                    *value += shift;
                }
            }
            all.push(system);
        }
    }
    all
}

fn compare(systems: &[KktSystem], library: Option<&Library>) -> [Option<Times>; 2] {
    let symbolic = &systems[0].symbolic;
    let n = symbolic.len();
    let (mut multifrontal, mut by_mumps) = (Times::default(), Times::default());
    let mut analyses = Vec::new();
    for _ in 0..REPETITIONS {
        let pattern = symbolic.pattern().clone();
        timed(&mut analyses, || black_box(Symbolic::new(pattern)));
    }
    multifrontal.analyse = median(&mut analyses);
    let mut factors = Factors::new(symbolic);
    let mumps = library.map(|library| Mumps::new(library, symbolic));
    if let Some(mumps) = &mumps {
        let mut analyses = Vec::new();
        let mut values = systems[0].values.clone();
        for _ in 0..REPETITIONS {
            timed(&mut analyses, || mumps.call(b"mumps_analyse", &mut values));
        }
        by_mumps.analyse = median(&mut analyses);
    }
    for system in systems {
        let b = system.right_hand_sides.first().cloned();
        let b = b.unwrap_or_else(|| vec![1.0; n]);
        let mut values = system.values.clone();
        let mut times = [const { Vec::new() }; 4];
        let mut negative = [0, 0];
        for _ in 0..REPETITIONS {
            let found = timed(&mut times[0], || {
                factors.factor(symbolic, &values, system.threshold)
            });
            negative[0] = found.expect("finite").negative;
            let mut x = b.clone();
            timed(&mut times[1], || factors.solve(symbolic, &mut x));
        }
        for _ in 0..REPETITIONS {
            if let Some(mumps) = &mumps {
                let found = timed(&mut times[2], || mumps.call(b"mumps_factor", &mut values));
                negative[1] = found as usize;
                let mut x = b.clone();
                timed(&mut times[3], || mumps.call(b"mumps_solve", &mut x));
            }
        }
        let part = 1.0 / systems.len() as f64;
        multifrontal.factor += part * median(&mut times[0]);
        multifrontal.solve += part * median(&mut times[1]);
        let found = accuracy(symbolic, &values, &b, |x| factors.solve(symbolic, x));
        multifrontal.residual = multifrontal.residual.max(found);
        if let Some(mumps) = &mumps {
            by_mumps.factor += part * median(&mut times[2]);
            by_mumps.solve += part * median(&mut times[3]);
            let found = accuracy(symbolic, &values, &b, |x| {
                mumps.call(b"mumps_solve", x);
            });
            by_mumps.residual = by_mumps.residual.max(found);
            multifrontal.wrong += usize::from(negative[0] != negative[1]);
        }
    }
    [Some(multifrontal), mumps.map(|_| by_mumps)]
}

/// Operations of a factorisation and a solution against what the machine could do.
fn roofline(symbolic: &Symbolic, multifrontal: &Times, peak: f64) {
    let size = symbolic.factor_size() as f64;
    let threads = symbolic.concurrency().min(parallel::thread_count());
    // A solution takes every number of the factors twice, for one multiplication and addition.
    for (what, operations, bytes, time, threads) in [
        (
            "factor",
            2.0 * symbolic.multiplications(),
            16.0 * size,
            multifrontal.factor,
            threads,
        ),
        ("solve", 4.0 * size, 16.0 * size, multifrontal.solve, 1),
    ] {
        let speed = 1e-3 * operations / time;
        let peak = peak * threads as f64;
        let traffic = 1e-3 * bytes / time;
        let bandwidth = bandwidth(symbolic.factor_size()) * threads as f64;
        println!(
            "{:>8} roofline, {what:>6}: {:.2} Mflop, {speed:.1} Gflop/s of {peak:.0} ({:.0} %); \
             factors at {traffic:.0} GB/s of {bandwidth:.0} ({:.0} %)",
            "",
            1e-6 * operations,
            100.0 * speed / peak,
            100.0 * traffic / bandwidth,
        );
    }
}

fn main() {
    // `cargo bench` names itself; `cargo test --benches` only wants to see it start.
    if !std::env::args().any(|argument| argument == "--bench") {
        return;
    }
    let shim = std::env::var_os("FFSM_MUMPS_SHIM");
    // SAFETY: the shim has no initialisers of its own.
    let library = shim.map(|path| unsafe { Library::new(path) }.expect("the shim loads"));
    let peak = peak();
    println!(
        "{:>8} {:>6} {:>8} {:>8}  {:>12} {:>12} {:>11} {:>10} {:>10}",
        "robot",
        "mesh",
        "unknowns",
        "systems",
        "solver",
        "analyse / µs",
        "factor / µs",
        "solve / µs",
        "residual"
    );
    let shipped = |name| ProblemFile::shipped(name).expect("a problem").problem;
    let cases = [
        ("two-link", shipped("table1-relaxed"), [10, 5]),
        ("two-link", shipped("table1-relaxed"), [50, 4]),
        ("two-link", shipped("table1-relaxed"), [200, 4]),
        ("chaser", shipped("chaser-7dof"), [10, 5]),
    ];
    for (robot, problem, [segments, points]) in cases {
        let problem = problem
            .edited(|problem| {
                problem.mesh.segments = segments;
                problem.mesh.points = points;
                problem.mesh.max_iterations = Some(1);
            })
            .expect("a valid problem");
        let (plan, systems) = record(|| Planner::new().plan(&problem));
        plan.expect("a plan");
        let systems = shifted(&systems);
        let both = compare(&systems, library.as_ref());
        for (name, times) in ["multifrontal", "MUMPS"].into_iter().zip(&both) {
            let Some(times) = times else { continue };
            println!(
                "{:>8} {:>6} {:>8} {:>8}  {:>12} {:>12.0} {:>11.1} {:>10.1} {:>10.1e}",
                robot,
                format!("{segments}×{points}"),
                systems[0].symbolic.len(),
                systems.len(),
                name,
                times.analyse,
                times.factor,
                times.solve,
                times.residual
            );
        }
        if let Some(multifrontal) = &both[0] {
            let symbolic = &systems[0].symbolic;
            println!(
                "{:>8} {} entries, {} fronts, {} numbers in the factors",
                "",
                symbolic.pattern().nonzeros(),
                symbolic.fronts(),
                symbolic.factor_size(),
            );
            roofline(symbolic, multifrontal, peak);
        }
        if let [Some(multifrontal), Some(by_mumps)] = &both {
            let once =
                (by_mumps.factor + by_mumps.solve) / (multifrontal.factor + multifrontal.solve);
            println!(
                "{:>8} factor and solve {once:.2} times faster, inertia unlike on {} systems",
                "", multifrontal.wrong
            );
        }
    }
}
