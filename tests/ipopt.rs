//! The Ipopt wrapper against programmes with known answers, and against misuse.

mod allocations;

use ffsm_ipopt::nlp::ipopt::{IpoptError, interrupt, linear_solvers, solve, version};
use ffsm_ipopt::nlp::{
    Control, Iterate, Nlp, OptionValue, Progress, Settings, Size, Solution, Status, Undefined,
};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::Command;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

// ---------------------------------------------------------------- programmes

type Scalar = fn(&[f64]) -> f64;
type Vector = fn(&[f64], &mut [f64]);
type Lagrangian = fn(&[f64], f64, &[f64], &mut [f64]);

/// A small programme with dense matrices, that watches how it is called.
struct Dense {
    variables: [Vec<f64>; 2],
    constraints: [Vec<f64>; 2],
    f: Scalar,
    df: Vector,
    g: Vector,
    /// Row by row.
    dg: Vector,
    /// Lower triangle, row by row.
    h: Lagrangian,
    /// Panics in the evaluation with this number, counted from 0.
    panic_at: Option<u32>,
    evaluations: u32,
    undefined: u32,
    new_points: u32,
    started: bool,
}

impl Dense {
    fn new(f: Scalar, df: Vector, h: Lagrangian, bounds: [Vec<f64>; 2]) -> Self {
        Self {
            variables: bounds,
            constraints: [vec![], vec![]],
            f,
            df,
            g: |_, _| {},
            dg: |_, _| {},
            h,
            panic_at: None,
            evaluations: 0,
            undefined: 0,
            new_points: 0,
            started: false,
        }
    }

    fn subject_to(mut self, g: Vector, dg: Vector, bounds: [Vec<f64>; 2]) -> Self {
        (self.g, self.dg, self.constraints) = (g, dg, bounds);
        self
    }

    fn n(&self) -> usize {
        self.variables[0].len()
    }

    fn m(&self) -> usize {
        self.constraints[0].len()
    }

    fn check(&mut self, values: &[f64]) -> Result<(), Undefined> {
        assert!(self.started, "new_point comes before the first evaluation");
        self.evaluations += 1;
        if self.panic_at == Some(self.evaluations - 1) {
            panic!("deliberate {}", self.evaluations - 1);
        }
        if values.iter().all(|value| value.is_finite()) {
            return Ok(());
        }
        self.undefined += 1;
        Err(Undefined {
            function: "test function",
        })
    }
}

impl Nlp for Dense {
    fn size(&self) -> Size {
        Size {
            variables: self.n(),
            constraints: self.m(),
            jacobian_nonzeros: self.n() * self.m(),
            hessian_nonzeros: self.n() * (self.n() + 1) / 2,
        }
    }

    fn variable_bounds(&self, lower: &mut [f64], upper: &mut [f64]) {
        lower.copy_from_slice(&self.variables[0]);
        upper.copy_from_slice(&self.variables[1]);
    }

    fn constraint_bounds(&self, lower: &mut [f64], upper: &mut [f64]) {
        lower.copy_from_slice(&self.constraints[0]);
        upper.copy_from_slice(&self.constraints[1]);
    }

    fn jacobian_structure(&self, rows: &mut [usize], columns: &mut [usize]) {
        for (entry, (row, column)) in rows.iter_mut().zip(columns).enumerate() {
            (*row, *column) = (entry / self.n(), entry % self.n());
        }
    }

    fn hessian_structure(&self, rows: &mut [usize], columns: &mut [usize]) {
        let lower = (0..self.n()).flat_map(|row| (0..=row).map(move |column| (row, column)));
        for (entry, (row, column)) in lower.enumerate() {
            (rows[entry], columns[entry]) = (row, column);
        }
    }

    fn new_point(&mut self) {
        self.started = true;
        self.new_points += 1;
    }

    fn objective(&mut self, x: &[f64]) -> Result<f64, Undefined> {
        let value = (self.f)(x);
        self.check(&[value]).map(|()| value)
    }

    fn gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<(), Undefined> {
        (self.df)(x, gradient);
        self.check(gradient)
    }

    fn constraints(&mut self, x: &[f64], values: &mut [f64]) -> Result<(), Undefined> {
        (self.g)(x, values);
        self.check(values)
    }

    fn jacobian(&mut self, x: &[f64], values: &mut [f64]) -> Result<(), Undefined> {
        (self.dg)(x, values);
        self.check(values)
    }

    fn hessian(
        &mut self,
        x: &[f64],
        sigma: f64,
        multipliers: &[f64],
        values: &mut [f64],
    ) -> Result<(), Undefined> {
        (self.h)(x, sigma, multipliers, values);
        self.check(values)
    }

    fn variable_name(&self, index: usize) -> String {
        format!("length {index}")
    }

    fn constraint_name(&self, index: usize) -> String {
        format!("row {index}")
    }
}

/// Problem 71 of Hock and Schittkowski.
fn hs071() -> Dense {
    Dense::new(
        |x| x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2],
        |x, d| {
            let sum = x[0] + x[1] + x[2];
            d.copy_from_slice(&[
                x[3] * (x[0] + sum),
                x[0] * x[3],
                x[0] * x[3] + 1.0,
                x[0] * sum,
            ]);
        },
        |x, sigma, l, h| {
            h.copy_from_slice(&[
                sigma * 2.0 * x[3] + 2.0 * l[1],
                sigma * x[3] + l[0] * x[2] * x[3],
                2.0 * l[1],
                sigma * x[3] + l[0] * x[1] * x[3],
                l[0] * x[0] * x[3],
                2.0 * l[1],
                sigma * (2.0 * x[0] + x[1] + x[2]) + l[0] * x[1] * x[2],
                sigma * x[0] + l[0] * x[0] * x[2],
                sigma * x[0] + l[0] * x[0] * x[1],
                2.0 * l[1],
            ]);
        },
        [vec![1.0; 4], vec![5.0; 4]],
    )
    .subject_to(
        |x, g| {
            g[0] = x[0] * x[1] * x[2] * x[3];
            g[1] = x.iter().map(|x| x * x).sum();
        },
        |x, d| {
            for j in 0..4 {
                d[j] = (0..4).filter(|&k| k != j).map(|k| x[k]).product();
                d[4 + j] = 2.0 * x[j];
            }
        },
        [vec![25.0, 40.0], vec![f64::INFINITY, 40.0]],
    )
}

const HS071_START: [f64; 4] = [1.0, 5.0, 5.0, 1.0];
const HS071_OPTIMUM: [f64; 4] = [1.0, 4.7429994, 3.8211503, 1.3794082];

/// The banana-shaped valley, without constraints.
fn rosenbrock() -> Dense {
    Dense::new(
        |x| (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2),
        |x, d| {
            let valley = x[1] - x[0] * x[0];
            d.copy_from_slice(&[-2.0 * (1.0 - x[0]) - 400.0 * x[0] * valley, 200.0 * valley]);
        },
        |x, sigma, _, h| {
            h[0] = sigma * (2.0 - 400.0 * (x[1] - 3.0 * x[0] * x[0]));
            h[1] = sigma * -400.0 * x[0];
            h[2] = sigma * 200.0;
        },
        free(2),
    )
}

/// Minimise x − log x, undefined from zero down; a full Newton step from 3 leads to −3.
fn logarithm() -> Dense {
    Dense::new(
        |x| x[0] - x[0].ln(),
        |x, d| {
            d[0] = if x[0] > 0.0 {
                1.0 - 1.0 / x[0]
            } else {
                f64::NAN
            }
        },
        |x, sigma, _, h| h[0] = sigma / (x[0] * x[0]),
        free(1),
    )
}

fn free(n: usize) -> [Vec<f64>; 2] {
    [vec![f64::NEG_INFINITY; n], vec![f64::INFINITY; n]]
}

// ---------------------------------------------------------------- helpers

fn run(nlp: &mut impl Nlp, settings: &Settings, start: &[f64]) -> Result<Solution, IpoptError> {
    solve(nlp, settings, &Iterate::primal(start.to_vec()), &mut |_| {
        Control::Continue
    })
}

fn with_option(name: &str, value: OptionValue) -> Settings {
    Settings {
        options: vec![(name.into(), value)],
        ..Settings::default()
    }
}

fn text(value: &str) -> OptionValue {
    OptionValue::Text(value.into())
}

fn assert_near(found: &[f64], wanted: &[f64], tolerance: f64) {
    assert_eq!(found.len(), wanted.len());
    for (found, wanted) in found.iter().zip(wanted) {
        assert!(
            (found - wanted).abs() <= tolerance,
            "{found} is not {wanted} to {tolerance}"
        );
    }
}

/// A bound as Ipopt relaxes it, and a little more.
fn relaxed(bound: f64, outwards: f64) -> f64 {
    bound + outwards * 1.01e-8 * bound.abs().max(1.0)
}

/// Asserts stationarity, complementarity and signs, worked out from the programme itself.
fn assert_optimal(nlp: &mut Dense, solution: &Solution, tolerance: f64) {
    let (n, m) = (nlp.n(), nlp.m());
    let Iterate {
        x,
        multipliers,
        lower_multipliers,
        upper_multipliers,
    } = &solution.iterate;
    let (mut df, mut dg, mut g) = (vec![0.0; n], vec![0.0; n * m], vec![0.0; m]);
    (nlp.df)(x, &mut df);
    (nlp.dg)(x, &mut dg);
    (nlp.g)(x, &mut g);
    assert_near(&solution.constraints, &g, 1e-12);
    assert_near(&[solution.objective], &[(nlp.f)(x)], 1e-12);
    for j in 0..n {
        let [lower, upper] = [nlp.variables[0][j], nlp.variables[1][j]];
        let (z_lower, z_upper) = (lower_multipliers[j], upper_multipliers[j]);
        let inside = relaxed(lower, -1.0)..=relaxed(upper, 1.0);
        assert!(inside.contains(&x[j]), "variable {j} is inside");
        assert!(z_lower >= 0.0 && z_upper >= 0.0);
        if lower == upper {
            continue;
        }
        let reduced = df[j] + (0..m).map(|i| multipliers[i] * dg[i * n + j]).sum::<f64>();
        assert!(
            (reduced - z_lower + z_upper).abs() <= tolerance,
            "variable {j} is stationary"
        );
        assert!(lower.is_infinite() || z_lower * (x[j] - lower) <= tolerance);
        assert!(upper.is_infinite() || z_upper * (upper - x[j]) <= tolerance);
    }
    for i in 0..m {
        let [lower, upper] = [nlp.constraints[0][i], nlp.constraints[1][i]];
        let inside = relaxed(lower, -1.0)..=relaxed(upper, 1.0);
        assert!(
            lower == upper && (g[i] - lower).abs() <= tolerance || inside.contains(&g[i]),
            "row {i} is feasible"
        );
        if lower < upper {
            // In f + λᵀg a lower bound pushes with λ < 0, an upper one with λ > 0.
            let active = if multipliers[i] < 0.0 {
                g[i] - lower
            } else {
                upper - g[i]
            };
            assert!(
                multipliers[i].abs() <= tolerance || active <= 1e-6,
                "row {i} is complementary"
            );
        }
    }
}

/// Runs one of these tests alone in another process, with `directory` its working directory and
/// `FFSM_CHILD` set; returns what it printed.
fn child(test: &str, directory: &Path) -> String {
    let output = Command::new(std::env::current_exe().expect("this test's own path"))
        .args([test, "--exact", "--nocapture", "--test-threads=1"])
        .env("FFSM_CHILD", "1")
        .current_dir(directory)
        .output()
        .expect("the test starts again");
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        output.status.success(),
        "{printed}\n{}",
        String::from_utf8_lossy(&output.stderr)
    );
    printed
}

fn is_child() -> bool {
    std::env::var_os("FFSM_CHILD").is_some()
}

// ---------------------------------------------------------------- answers

#[test]
fn hs071_reaches_its_known_optimum() {
    let mut nlp = hs071();
    let solution = run(&mut nlp, &Settings::default(), &HS071_START).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_near(&solution.iterate.x, &HS071_OPTIMUM, 1e-6);
    assert_near(&[solution.objective], &[17.0140173], 1e-6);
    assert!(
        solution.iterate.multipliers[0] < 0.0,
        "the product's lower bound is active"
    );
    assert!(
        solution.iterate.lower_multipliers[0] > 1.0,
        "the first variable is at its bound"
    );
    assert_optimal(&mut nlp, &solution, 1e-7);

    let statistics = solution.statistics;
    assert!((5..20).contains(&statistics.iterations));
    assert!(statistics.primal_infeasibility < 1e-8 && statistics.dual_infeasibility < 1e-8);
    assert!(statistics.barrier < 1e-8);
    assert!(
        statistics
            .evaluations
            .iter()
            .all(|&count| count >= statistics.iterations)
    );
    assert_eq!(statistics.evaluations.iter().sum::<u32>(), nlp.evaluations);
    assert!(nlp.new_points > statistics.iterations && nlp.new_points < nlp.evaluations);
}

#[test]
fn a_programme_without_constraints_is_solved() {
    let mut nlp = rosenbrock();
    let solution = run(&mut nlp, &Settings::default(), &[-1.2, 1.0]).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_near(&solution.iterate.x, &[1.0, 1.0], 1e-7);
    assert!(solution.constraints.is_empty() && solution.iterate.multipliers.is_empty());
}

#[test]
fn a_fixed_variable_stays() {
    let mut nlp = hs071();
    (nlp.variables[0][3], nlp.variables[1][3]) = (1.5, 1.5);
    let solution = run(&mut nlp, &Settings::default(), &HS071_START).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_eq!(solution.iterate.x[3], 1.5);
    assert_optimal(&mut nlp, &solution, 1e-7);
}

#[test]
fn an_infeasible_programme_is_called_so() {
    // Within the unit circle, and at x + y = 3.
    let mut nlp = Dense::new(
        |x| x[0],
        |_, d| d.copy_from_slice(&[1.0, 0.0]),
        |_, _, l, h| h.copy_from_slice(&[2.0 * l[0], 0.0, 2.0 * l[0]]),
        free(2),
    )
    .subject_to(
        |x, g| g.copy_from_slice(&[x[0] * x[0] + x[1] * x[1], x[0] + x[1]]),
        |x, d| d.copy_from_slice(&[2.0 * x[0], 2.0 * x[1], 1.0, 1.0]),
        [vec![f64::NEG_INFINITY, 3.0], vec![1.0, 3.0]],
    );
    let mut restoration = false;
    let start = Iterate::primal(vec![0.3, 0.1]);
    let solution = solve(&mut nlp, &Settings::default(), &start, &mut |progress| {
        restoration |= progress.restoration;
        Control::Continue
    });
    assert_eq!(solution.unwrap().status, Status::LocallyInfeasible);
    assert!(restoration, "the monitor sees the restoration phase");
}

#[test]
fn more_equations_than_variables_are_called_so() {
    let mut nlp = Dense::new(
        |x| x[0],
        |_, d| d[0] = 1.0,
        |_, _, _, h| h[0] = 0.0,
        free(1),
    )
    .subject_to(
        |x, g| g.copy_from_slice(&[x[0], x[0] * x[0]]),
        |x, d| d.copy_from_slice(&[1.0, 2.0 * x[0]]),
        [vec![1.0, 2.0], vec![1.0, 2.0]],
    );
    let solution = run(&mut nlp, &Settings::default(), &[0.5]).unwrap();
    assert_eq!(solution.status, Status::TooFewDegreesOfFreedom);
    assert_eq!(solution.iterate.x, [0.5]);
    assert!(solution.objective.is_nan());
}

#[test]
fn undefined_trial_points_only_shorten_the_step() {
    let mut nlp = logarithm();
    let solution = run(&mut nlp, &Settings::default(), &[3.0]).unwrap();
    assert!(nlp.undefined > 0, "the test means to leave the domain");
    assert_eq!(solution.status, Status::Solved);
    assert_near(&solution.iterate.x, &[1.0], 1e-6);
}

#[test]
fn an_undefined_start_is_an_invalid_number() {
    let solution = run(&mut logarithm(), &Settings::default(), &[-3.0]).unwrap();
    assert_eq!(solution.status, Status::InvalidNumber);
}

#[test]
fn the_iteration_limit_is_a_status_with_an_iterate() {
    let settings = Settings {
        max_iterations: 3,
        ..Settings::default()
    };
    let solution = run(&mut hs071(), &settings, &HS071_START).unwrap();
    assert_eq!(solution.status, Status::MaxIterations);
    assert_eq!(solution.statistics.iterations, 3);
    assert!(solution.objective.is_finite());
}

#[test]
fn a_warm_start_takes_fewer_iterations() {
    let cold = run(&mut hs071(), &Settings::default(), &HS071_START).unwrap();
    let again = run(&mut hs071(), &Settings::default(), &cold.iterate.x).unwrap();
    let settings = Settings {
        warm_start: Some(1e-8),
        ..Settings::default()
    };
    let mut nlp = hs071();
    let warm = solve(&mut nlp, &settings, &cold.iterate, &mut |_| {
        Control::Continue
    })
    .unwrap();
    assert_eq!(warm.status, Status::Solved);
    assert_optimal(&mut nlp, &warm, 1e-7);
    let [cold, again, warm] = [cold, again, warm].map(|solution| solution.statistics.iterations);
    assert!(
        warm <= 3 && warm < again && warm < cold,
        "{warm} of {again} and {cold}"
    );
}

// ---------------------------------------------------------------- stopping

#[test]
fn the_monitor_stops_a_solve_at_its_iterate() {
    let mut seen: Vec<Progress> = Vec::new();
    let start = Iterate::primal(HS071_START.to_vec());
    let mut nlp = hs071();
    let solution = solve(&mut nlp, &Settings::default(), &start, &mut |progress| {
        seen.push(*progress);
        if progress.iteration == 3 {
            Control::Stop
        } else {
            Control::Continue
        }
    })
    .unwrap();
    assert_eq!(solution.status, Status::Interrupted);
    assert_eq!(solution.statistics.iterations, 3);
    let iterations: Vec<_> = seen.iter().map(|progress| progress.iteration).collect();
    assert_eq!(iterations, [0, 1, 2, 3]);
    assert_near(&[solution.objective], &[(nlp.f)(&solution.iterate.x)], 1e-6);
    assert_near(&[solution.objective], &[seen[3].objective], 1e-6);
    assert_ne!(solution.iterate.x, HS071_START);
}

#[test]
fn an_interrupt_stops_a_solve() {
    // The flag is the whole process's: other tests must not see it.
    if !is_child() {
        child("an_interrupt_stops_a_solve", &std::env::temp_dir());
        return;
    }
    let start = Iterate::primal(HS071_START.to_vec());
    let solution = solve(
        &mut hs071(),
        &Settings::default(),
        &start,
        &mut |progress| {
            interrupt::flag().store(progress.iteration == 2, Ordering::Relaxed);
            Control::Continue
        },
    )
    .unwrap();
    assert!(interrupt::requested());
    assert_eq!(solution.status, Status::Interrupted);
    assert_eq!(solution.statistics.iterations, 2);
}

#[test]
fn a_panic_comes_back_whole_and_leaves_nothing_broken() {
    let evaluations = {
        let mut nlp = hs071();
        run(&mut nlp, &Settings::default(), &HS071_START).unwrap();
        nlp.evaluations
    };
    for panic_at in 0..evaluations {
        let mut nlp = hs071();
        nlp.panic_at = Some(panic_at);
        let solving = AssertUnwindSafe(|| run(&mut nlp, &Settings::default(), &HS071_START));
        let payload = catch_unwind(solving).expect_err("the panic is resumed");
        assert_eq!(
            *payload.downcast::<String>().unwrap(),
            format!("deliberate {panic_at}")
        );
        assert_eq!(
            nlp.evaluations,
            panic_at + 1,
            "nothing is called after the panic"
        );
    }
    let start = Iterate::primal(HS071_START.to_vec());
    let payload = catch_unwind(|| {
        solve(&mut hs071(), &Settings::default(), &start, &mut |_| {
            std::panic::panic_any(71_u8);
        })
    })
    .expect_err("the monitor's panic is resumed");
    assert_eq!(*payload.downcast::<u8>().unwrap(), 71);
    let solution = run(&mut hs071(), &Settings::default(), &HS071_START).unwrap();
    assert_eq!(solution.status, Status::Solved);
}

// ---------------------------------------------------------------- surroundings

#[test]
fn an_option_file_in_the_working_directory_is_not_read() {
    if !is_child() {
        let directory = tempfile::tempdir().unwrap();
        std::fs::write(
            directory.path().join("ipopt.opt"),
            "max_iter 0\nprint_level 5\n",
        )
        .unwrap();
        child(
            "an_option_file_in_the_working_directory_is_not_read",
            directory.path(),
        );
        return;
    }
    assert!(Path::new("ipopt.opt").exists());
    let solution = run(&mut hs071(), &Settings::default(), &HS071_START).unwrap();
    assert_eq!(solution.status, Status::Solved);
}

#[test]
fn nothing_is_printed_or_left_behind_unless_asked() {
    if !is_child() {
        let directory = tempfile::tempdir().unwrap();
        let printed = child(
            "nothing_is_printed_or_left_behind_unless_asked",
            directory.path(),
        );
        let (quiet, loud) = printed
            .split_once("<quiet>")
            .unwrap()
            .1
            .split_once("<loud>")
            .unwrap();
        assert_eq!(quiet.trim(), "");
        assert!(loud.contains("inf_pr"), "{loud}");
        assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 0);
        return;
    }
    println!("<quiet>");
    let settings = Settings::default();
    assert!(run(&mut hs071(), &settings, &HS071_START).is_ok());
    assert!(run(&mut logarithm(), &settings, &[-3.0]).is_ok());
    assert!(
        run(
            &mut hs071(),
            &with_option("nonsense", text("1")),
            &HS071_START
        )
        .is_err()
    );
    assert!(
        run(
            &mut hs071(),
            &with_option("linear_solver", text("none")),
            &HS071_START
        )
        .is_err()
    );
    assert!(!linear_solvers().is_empty());
    // Ipopt prints through C's own buffer; the end of a solve empties it.
    assert!(run(&mut hs071(), &settings, &HS071_START).is_ok());
    println!("<loud>");
    let settings = Settings {
        print_level: 5,
        ..settings
    };
    assert!(run(&mut hs071(), &settings, &HS071_START).is_ok());
}

#[test]
fn two_threads_solve_at_once() {
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                for _ in 0..100 {
                    let mut nlp = hs071();
                    let solution = run(&mut nlp, &Settings::default(), &HS071_START).unwrap();
                    assert_eq!(solution.status, Status::Solved);
                    assert_near(&solution.iterate.x, &HS071_OPTIMUM, 1e-6);
                }
            });
        }
    });
}

#[test]
fn a_solve_inside_a_solve_is_refused() {
    let nested = |linear_solver: &str| {
        let settings = Settings {
            linear_solver: linear_solver.into(),
            ..Settings::default()
        };
        let start = Iterate::primal(HS071_START.to_vec());
        let mut inner = None;
        let outer = solve(&mut hs071(), &settings, &start, &mut |_| {
            inner.get_or_insert_with(|| run(&mut hs071(), &settings, &HS071_START));
            Control::Continue
        });
        assert_eq!(outer.unwrap().status, Status::Solved);
        inner.unwrap()
    };
    assert_eq!(nested("mumps"), Err(IpoptError::Nested("mumps".into())));
    // Ours keeps no state outside the solve.
    let inner = nested("ours");
    assert_eq!(inner.unwrap().status, Status::Solved);
}

/// Four threads with problems of their own for `time`, against one thread.
fn threads_agree(time: Duration) {
    assert!(!ffsm_ipopt::nlp::ipopt::serialised("ours"));
    let case = |kind: usize| {
        let settings = Settings {
            linear_solver: "ours".into(),
            ..Settings::default()
        };
        let solution = if kind == 0 {
            run(&mut hs071(), &settings, &HS071_START).unwrap()
        } else {
            let points = 20 + 37 * kind;
            let mut nlp = Chain {
                points,
                upper: false,
            };
            run(&mut nlp, &settings, &vec![0.9; points]).unwrap()
        };
        assert_eq!(solution.statistics.fallbacks, 0);
        (solution.status, solution.iterate, solution.constraints)
    };
    let alone: Vec<_> = (0..8).map(case).collect();
    let begin = Instant::now();
    std::thread::scope(|scope| {
        for thread in 0..4 {
            let alone = &alone;
            scope.spawn(move || {
                let mut next = thread;
                while begin.elapsed() < time {
                    assert_eq!(case(next % 8), alone[next % 8], "case {}", next % 8);
                    next += 1;
                }
                assert!(next > thread + 8, "too few solves to tell");
            });
        }
    });
}

#[test]
fn four_threads_find_what_one_finds() {
    threads_agree(Duration::from_secs(2));
}

/// `make test-threads`.
#[test]
#[ignore = "takes a minute"]
fn four_threads_find_what_one_finds_for_a_minute() {
    threads_agree(Duration::from_secs(60));
}

#[test]
fn ours_finds_what_mumps_finds() {
    for points in [2, 3, 50, 300] {
        let mut nlp = Chain {
            points,
            upper: false,
        };
        let [ours, mumps] = ["ours", "mumps"].map(|name| {
            let settings = Settings {
                linear_solver: name.into(),
                ..Settings::default()
            };
            run(&mut nlp, &settings, &vec![0.9; points]).unwrap()
        });
        assert_eq!(
            (ours.status, mumps.status),
            (Status::Solved, Status::Solved)
        );
        assert_eq!(ours.statistics.fallbacks, 0);
        assert!(ours.statistics.iterations <= mumps.statistics.iterations);
        assert_near(&ours.iterate.x, &mumps.iterate.x, 1e-7);
    }
}

#[test]
fn the_linear_solvers_listed_are_those_that_solve() {
    let listed = linear_solvers();
    assert!(listed.contains(&"mumps"), "{listed:?}");
    for name in ["ours", "ma27", "ma97", "pardiso", "spral", "unheard-of"] {
        let settings = Settings {
            linear_solver: name.into(),
            ..Settings::default()
        };
        let solved = run(&mut hs071(), &settings, &HS071_START);
        assert_eq!(solved.is_ok(), listed.contains(&name), "{name}: {solved:?}");
    }
}

#[test]
fn the_version_is_one_this_was_made_for() {
    let minor = version()
        .strip_prefix("3.")
        .and_then(|rest| rest.split('.').next());
    assert!(
        (11..).contains(&minor.unwrap().parse::<u32>().unwrap()),
        "{}",
        version()
    );
}

// ---------------------------------------------------------------- options

#[test]
fn a_refused_option_is_named() {
    for (name, value, shown) in [
        (
            "no_such_option",
            OptionValue::Integer(1),
            "no_such_option = 1",
        ),
        (
            "mu_strategy",
            text("sideways"),
            "mu_strategy = \"sideways\"",
        ),
        ("max_iter", OptionValue::Real(2.5), "max_iter = 2.5"),
        ("tol", OptionValue::Real(-1.0), "tol = -1"),
        ("mu_strategy", text("nul\0"), "mu_strategy"),
    ] {
        let error = run(&mut hs071(), &with_option(name, value), &HS071_START).unwrap_err();
        assert!(matches!(&error, IpoptError::OptionRefused { name: named, .. } if named == name));
        assert!(error.to_string().contains(shown), "{error}");
    }
}

#[test]
fn options_by_name_come_last() {
    let settings = with_option("max_iter", OptionValue::Integer(2));
    let solution = run(&mut hs071(), &settings, &HS071_START).unwrap();
    assert_eq!(solution.status, Status::MaxIterations);
    // A whole number will do for a real one.
    let settings = with_option("bound_relax_factor", OptionValue::Integer(0));
    let solution = run(&mut hs071(), &settings, &HS071_START).unwrap();
    assert_eq!(solution.status, Status::Solved);
    // MUMPS's own choice of ordering is to be had.
    let mut settings = with_option("mumps_pivot_order", OptionValue::Integer(7));
    settings.linear_solver = "mumps".into();
    let solution = run(&mut hs071(), &settings, &HS071_START).unwrap();
    assert_eq!(solution.status, Status::Solved);
}

#[test]
fn an_absent_linear_solver_is_an_error_and_not_the_end_of_the_process() {
    for name in ["ma97", "MA97", "ma27", "pardiso"] {
        if linear_solvers().contains(&name.to_lowercase().as_str()) {
            continue;
        }
        let error = run(
            &mut hs071(),
            &with_option("linear_solver", text(name)),
            &HS071_START,
        );
        let message = error.unwrap_err().to_string();
        assert!(
            message.contains(&name.to_lowercase()) && message.contains("mumps"),
            "{message}"
        );
    }
    let settings = with_option("nlp_scaling_method", text("equilibration-based"));
    if let Err(error) = run(&mut hs071(), &settings, &HS071_START) {
        assert!(error.to_string().contains("equilibration-based"), "{error}");
    }
}

// ---------------------------------------------------------------- misuse

#[test]
fn a_start_of_the_wrong_length_is_refused() {
    let error = run(&mut hs071(), &Settings::default(), &[1.0; 3]).unwrap_err();
    assert_eq!(
        error,
        IpoptError::StartDimension {
            what: "variables",
            expected: 4,
            found: 3
        },
        "{error}"
    );
}

#[test]
fn a_start_that_is_not_finite_is_refused_by_name() {
    let error = run(
        &mut hs071(),
        &Settings::default(),
        &[1.0, 5.0, f64::NAN, 1.0],
    )
    .unwrap_err();
    assert!(error.to_string().contains("length 2 is NaN"), "{error}");
}

#[test]
fn a_warm_start_needs_multipliers_and_a_barrier_parameter() {
    let settings = Settings {
        warm_start: Some(1e-6),
        ..Settings::default()
    };
    let error = run(&mut hs071(), &settings, &HS071_START).unwrap_err();
    assert_eq!(error, IpoptError::NoMultipliers);
    let settings = Settings {
        warm_start: Some(0.0),
        ..Settings::default()
    };
    let error = run(&mut hs071(), &settings, &HS071_START).unwrap_err();
    assert_eq!(error, IpoptError::Barrier(0.0));
    let mut start = run(&mut hs071(), &Settings::default(), &HS071_START)
        .unwrap()
        .iterate;
    start.multipliers[1] = f64::INFINITY;
    let settings = Settings {
        warm_start: Some(1e-6),
        ..Settings::default()
    };
    let error = solve(&mut hs071(), &settings, &start, &mut |_| Control::Continue).unwrap_err();
    assert!(
        error.to_string().contains("multiplier of row 1 is inf"),
        "{error}"
    );
}

#[test]
fn bounds_that_leave_no_value_are_refused_by_name() {
    let mut nlp = hs071();
    nlp.variables[0][1] = 6.0;
    let error = run(&mut nlp, &Settings::default(), &HS071_START).unwrap_err();
    assert!(error.to_string().contains("length 1") && error.to_string().contains("6 to 5"));
    for bad in [f64::NAN, f64::INFINITY] {
        let mut nlp = hs071();
        nlp.constraints[0][0] = bad;
        let error = run(&mut nlp, &Settings::default(), &HS071_START).unwrap_err();
        assert!(error.to_string().contains("row 0"), "{error}");
    }
}

#[test]
fn a_programme_without_variables_is_refused() {
    let mut nlp = Dense::new(|_| 0.0, |_, _| {}, |_, _, _, _| {}, free(0));
    let error = run(&mut nlp, &Settings::default(), &[]).unwrap_err();
    assert!(
        matches!(error, IpoptError::Creation { variables: 0, .. }),
        "{error}"
    );
}

#[test]
fn an_entry_above_the_diagonal_is_refused() {
    let mut nlp = Chain {
        points: 3,
        upper: true,
    };
    let error = run(&mut nlp, &Settings::default(), &[0.0; 3]).unwrap_err();
    assert!(
        matches!(
            error,
            IpoptError::Structure {
                entry: 3,
                row: 0,
                column: 1,
                ..
            }
        ),
        "{error}"
    );
}

// ---------------------------------------------------------------- time and memory

/// A chain of coupled valleys, large enough that its linear algebra takes time.
struct Chain {
    points: usize,
    /// Whether to give the Hessian's upper triangle by mistake.
    upper: bool,
}

impl Nlp for Chain {
    fn size(&self) -> Size {
        Size {
            variables: self.points,
            constraints: 0,
            jacobian_nonzeros: 0,
            hessian_nonzeros: 2 * self.points - 1,
        }
    }

    fn variable_bounds(&self, lower: &mut [f64], upper: &mut [f64]) {
        lower.fill(-10.0);
        upper.fill(10.0);
    }

    fn constraint_bounds(&self, _: &mut [f64], _: &mut [f64]) {}

    fn jacobian_structure(&self, _: &mut [usize], _: &mut [usize]) {}

    fn hessian_structure(&self, rows: &mut [usize], columns: &mut [usize]) {
        for i in 0..self.points {
            (rows[i], columns[i]) = (i, i);
        }
        for i in 1..self.points {
            let entry = self.points + i - 1;
            let (row, column) = if self.upper { (i - 1, i) } else { (i, i - 1) };
            (rows[entry], columns[entry]) = (row, column);
        }
    }

    fn new_point(&mut self) {}

    fn objective(&mut self, x: &[f64]) -> Result<f64, Undefined> {
        let valley = |x: &[f64]| (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2);
        Ok(x.windows(2).map(valley).sum())
    }

    fn gradient(&mut self, x: &[f64], gradient: &mut [f64]) -> Result<(), Undefined> {
        gradient.fill(0.0);
        for i in 1..x.len() {
            let valley = x[i] - x[i - 1] * x[i - 1];
            gradient[i - 1] += -2.0 * (1.0 - x[i - 1]) - 400.0 * x[i - 1] * valley;
            gradient[i] += 200.0 * valley;
        }
        Ok(())
    }

    fn constraints(&mut self, _: &[f64], _: &mut [f64]) -> Result<(), Undefined> {
        Ok(())
    }

    fn jacobian(&mut self, _: &[f64], _: &mut [f64]) -> Result<(), Undefined> {
        Ok(())
    }

    fn hessian(
        &mut self,
        x: &[f64],
        sigma: f64,
        _: &[f64],
        values: &mut [f64],
    ) -> Result<(), Undefined> {
        values.fill(0.0);
        for i in 1..x.len() {
            let curvature = 2.0 - 400.0 * (x[i] - 3.0 * x[i - 1] * x[i - 1]);
            values[i - 1] += sigma * curvature;
            values[i] += sigma * 200.0;
            values[x.len() + i - 1] = sigma * -400.0 * x[i - 1];
        }
        Ok(())
    }
}

#[test]
fn the_parts_of_the_time_fit_into_the_whole() {
    let mut nlp = Chain {
        points: 5000,
        upper: false,
    };
    let start = vec![0.9; nlp.points];
    let timed = run(&mut nlp, &Settings::default(), &start).unwrap();
    assert_eq!(timed.status, Status::Solved);
    let statistics = timed.statistics;
    assert!(statistics.linear_solver > Duration::ZERO, "{statistics:?}");
    assert!(statistics.derivatives > Duration::ZERO, "{statistics:?}");
    assert!(statistics.linear_solver + statistics.derivatives <= statistics.total);

    let settings = Settings {
        timing: false,
        ..Settings::default()
    };
    let untimed = run(&mut nlp, &settings, &start).unwrap();
    assert_eq!(untimed.statistics.linear_solver, Duration::ZERO);
    assert_eq!(untimed.iterate, timed.iterate, "timing changes nothing");
}

#[test]
fn callbacks_and_linear_solver_do_not_allocate() {
    let mut nlp = Chain {
        points: 50,
        upper: false,
    };
    let start = Iterate::primal(vec![0.9; nlp.points]);
    let (mut first, mut last) = (None, 0);
    let solution = solve(&mut nlp, &Settings::default(), &start, &mut |progress| {
        last = allocations::so_far();
        // The linear solver analyses the structure in the first iteration.
        if progress.iteration > 0 {
            first.get_or_insert(last);
        }
        Control::Continue
    })
    .unwrap();
    assert!(solution.statistics.iterations > 3);
    assert_eq!(solution.statistics.fallbacks, 0);
    assert_eq!(first, Some(last));
}
