//! Problems with known optima, refined by either law, as JSON lines for `make bench`.
//!
//! ```sh
//! cargo run --release --example known_optima_bench -- free-flying-robot structure 1e-6
//! ```
//!
//! Without arguments: every problem by both laws.

use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::ocp::{self, Ends, Formulation, Interval, Ocp, Point, Quantity};
use ffsm_ipopt::refine::Law;
use std::error::Error;
use std::f64::consts::FRAC_PI_2;
use std::time::Instant;

#[allow(dead_code)]
#[path = "free_flying_robot.rs"]
pub mod free_flying_robot;

/// ẍ = u from (x, ẋ) to a goal, with the cost ∫(a·x² + b·ẋ² + c·u²) dt + d·t_f.
struct Integrator {
    start: [f64; 2],
    goal: [Interval; 2],
    highest: f64,
    control: Interval,
    duration: Interval,
    weights: [f64; 3],
    time_weight: f64,
}

impl Ocp for Integrator {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let below = Interval::new(f64::NEG_INFINITY, self.highest);
        let [x, rate] = self.start.map(Interval::fixed);
        Formulation::over(self.duration)
            .state(Quantity::new("x", below), x, self.goal[0])
            .state(Quantity::new("rate", Interval::FREE), rate, self.goal[1])
            .control(Quantity::new("u", self.control))
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(&self, p: Point<'_, S>, _: &mut (), f: &mut [S], _: &mut [S]) -> S {
        let [a, b, c] = self.weights;
        f[0] = p.x[1];
        f[1] = p.u[0];
        p.x[0].square() * a + p.x[1].square() * b + p.u[0].square() * c
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), _: &mut [S]) -> S {
        ends.duration * self.time_weight
    }
}

/// Rest to rest over a distance of one in the least time, −1 ≤ u ≤ 7/10.
fn minimum_time() -> Integrator {
    Integrator {
        start: [0.0, 0.0],
        goal: [1.0, 0.0].map(Interval::fixed),
        highest: f64::INFINITY,
        control: Interval::new(-1.0, 0.7),
        duration: Interval::new(0.5, 10.0),
        weights: [0.0; 3],
        time_weight: 1.0,
    }
}

/// Bryson and Denham's: the position stays below 1/9.
fn bryson_denham() -> Integrator {
    Integrator {
        start: [0.0, 1.0],
        goal: [0.0, -1.0].map(Interval::fixed),
        highest: 1.0 / 9.0,
        control: Interval::FREE,
        duration: Interval::fixed(1.0),
        weights: [0.0, 0.0, 0.5],
        time_weight: 0.0,
    }
}

/// A bang arc, then a singular one.
fn singular() -> Integrator {
    Integrator {
        start: [0.0, 1.0],
        goal: [Interval::FREE; 2],
        highest: f64::INFINITY,
        control: Interval::symmetric(1.0),
        duration: Interval::fixed(5.0),
        weights: [0.5, 0.5, 0.0],
        time_weight: 0.0,
    }
}

/// Aly and Chan's: singular throughout, u = −sin t.
fn aly_chan() -> Integrator {
    Integrator {
        duration: Interval::fixed(FRAC_PI_2),
        weights: [-0.5, 0.5, 0.0],
        ..singular()
    }
}

/// Of the problem of that name.
const OPTIMA: [(&str, f64); 5] = [
    ("minimum-time", 2.203_892_660_1),
    ("bryson-denham", 4.0),
    ("singular", 0.376_991_93),
    ("aly-chan", 0.0),
    ("free-flying-robot", 7.910_154),
];

fn solve(name: &str, law: Law, tolerance: f64) -> Result<f64, Box<dyn Error>> {
    match name {
        "minimum-time" => timed(name, &minimum_time(), law, tolerance),
        "bryson-denham" => timed(name, &bryson_denham(), law, tolerance),
        "singular" => timed(name, &singular(), law, tolerance),
        "aly-chan" => timed(name, &aly_chan(), law, tolerance),
        "free-flying-robot" => timed(name, &free_flying_robot::Robot, law, tolerance),
        _ => unreachable!("{name} is one of OPTIMA"),
    }
}

/// Prints the figures of one refined solve from the straight line; its objective.
fn timed<O: Ocp>(name: &str, ocp: &O, law: Law, tolerance: f64) -> Result<f64, Box<dyn Error>> {
    let mut settings = ocp::Settings::default();
    settings.mesh.law = law;
    settings.mesh.tolerance = tolerance;
    settings.mesh.max_iterations = Some(20);
    settings.solver.max_iterations = 2000;
    let start = Instant::now();
    let outcome = ocp::solve(ocp, &settings)?;
    let seconds = start.elapsed().as_secs_f64();
    println!(
        r#"{{"problem": "{name}", "law": "{}", "points": {}, "solves": {}, "iterations": {}, "error": {:e}, "objective": {:e}, "seconds": {seconds:e}, "solved": {}}}"#,
        law.name(),
        outcome.trajectory.mesh.points(),
        outcome.records.len() + outcome.discarded.len(),
        outcome.statistics.iterations,
        outcome.max_error(),
        outcome.objective,
        outcome.converged
    );
    Ok(outcome.objective)
}

/// Runs the example; its assertions are tested.
pub fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    // A test has arguments of its own.
    let known = |name: &str| OPTIMA.iter().any(|(one, _)| *one == name);
    if let [name, law, tolerance] = &arguments[..]
        && known(name)
    {
        let law = Law::ALL.into_iter().find(|one| one.name() == law);
        let law = law.ok_or("the law is paper or structure")?;
        solve(name, law, tolerance.parse()?)?;
        return Ok(());
    }
    for (name, optimum) in OPTIMA {
        for law in Law::ALL {
            let gap = solve(name, law, 1e-5)? - optimum;
            assert!(gap.abs() < 1e-4 * (1.0 + optimum), "{name}: off by {gap:e}");
        }
    }
    Ok(())
}
