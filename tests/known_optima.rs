//! Optimal control problems with closed-form answers, through the generic interface.

use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::nlp::{self, Control};
use ffsm_ipopt::ocp::{Ends, Formulation, Interval, Ocp, Point, Quantity};
use ffsm_ipopt::refine::{Outcome, Refinement, Settings};
use ffsm_ipopt::transcription::Patterns;

/// Solves from the straight line and refines to the tolerance.
fn solve<O: Ocp>(ocp: &O, settings: &Settings) -> Outcome {
    settings.validate().unwrap();
    let solver = nlp::Settings {
        max_iterations: 2000,
        ..nlp::Settings::default()
    };
    let patterns = Patterns::detect(ocp);
    let refinement = Refinement {
        ocp,
        patterns: &patterns,
        settings,
        solver: &solver,
    };
    let start = refinement.straight_start().unwrap();
    let outcome = refinement.run(&start, &mut |_| Control::Continue).unwrap();
    assert!(outcome.status.is_solved(), "{:?}", outcome.status);
    outcome
}

fn refined(segments: usize, points: usize, tolerance: f64, max_iterations: usize) -> Settings {
    Settings {
        segments,
        points,
        tolerance,
        max_iterations,
        ..Settings::default()
    }
}

fn states(bounds: &[(&str, Interval)]) -> Vec<Quantity> {
    bounds
        .iter()
        .map(|(name, b)| Quantity::new(*name, *b))
        .collect()
}

fn fixed(values: &[f64]) -> Vec<Interval> {
    values.iter().copied().map(Interval::fixed).collect()
}

/// ẍ = u from `initial` to `terminal`, with the running cost `weight`·u².
struct Integrator {
    initial: [f64; 2],
    terminal: [f64; 2],
    position: Interval,
    weight: f64,
    control: Interval,
    duration: Interval,
    /// Minimise the duration as well.
    time_weight: f64,
}

impl Ocp for Integrator {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        Formulation {
            states: states(&[("position", self.position), ("rate", Interval::FREE)]),
            controls: vec![Quantity::new("force", self.control)],
            path: vec![],
            boundary: vec![],
            initial: fixed(&self.initial),
            terminal: fixed(&self.terminal),
            duration: self.duration,
        }
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(
        &self,
        p: Point<'_, S>,
        _: &mut (),
        rates: &mut [S],
        _: &mut [S],
    ) -> S {
        rates[0] = p.x[1];
        rates[1] = p.u[0];
        p.u[0].square() * self.weight
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), _: &mut [S]) -> S {
        ends.duration * self.time_weight
    }
}

fn bryson_denham(limit: f64) -> Integrator {
    Integrator {
        initial: [0.0, 1.0],
        terminal: [0.0, -1.0],
        position: Interval::new(f64::NEG_INFINITY, limit),
        weight: 0.5,
        control: Interval::FREE,
        duration: Interval::fixed(1.0),
        time_weight: 0.0,
    }
}

#[test]
fn bryson_denham_meets_4_over_9l() {
    for (limit, optimum) in [(1.0 / 9.0, 4.0), (0.1, 4.444444)] {
        let outcome = solve(&bryson_denham(limit), &refined(10, 5, 1e-8, 12));
        let gap = outcome.objective - optimum;
        assert!(gap.abs() < 2e-6, "L = {limit}: J = {}", outcome.objective);
    }
}

#[test]
fn bryson_denham_is_exact_when_breakpoints_stand_at_the_junctions() {
    // The optimal control is linear on [0, 3L], zero in between and linear again: with L = 1/9
    // and three equal segments polynomials of degree 3 hold the solution exactly.
    let problem = bryson_denham(1.0 / 9.0);
    let outcome = solve(&problem, &refined(3, 4, 1e-9, 1));
    // Ipopt relaxes bounds by 1e-8, and dJ/dL = −4/(9L²) = −36.
    assert!(
        (outcome.objective - 4.0).abs() < 4e-7,
        "J = {}",
        outcome.objective
    );
}

#[test]
fn double_integrator_is_exact_on_one_segment() {
    let problem = Integrator {
        initial: [0.0, 0.0],
        terminal: [1.0, 0.0],
        position: Interval::FREE,
        weight: 1.0,
        control: Interval::FREE,
        duration: Interval::fixed(1.0),
        time_weight: 0.0,
    };
    // The optimal position is a cubic: four points hold it exactly.
    let outcome = solve(&problem, &refined(1, 4, 1e-10, 1));
    assert!(
        (outcome.objective - 12.0).abs() < 1e-9,
        "J = {}",
        outcome.objective
    );
    assert!(outcome.max_error() < 1e-10);
}

#[test]
fn minimum_time_double_integrator_takes_two_seconds() {
    let problem = Integrator {
        initial: [0.0, 0.0],
        terminal: [1.0, 0.0],
        position: Interval::FREE,
        weight: 0.0,
        control: Interval::symmetric(1.0),
        duration: Interval::new(0.5, 10.0),
        time_weight: 1.0,
    };
    // A breakpoint at the switch makes it exact.
    let outcome = solve(&problem, &refined(2, 4, 1e-7, 1));
    assert!(
        (outcome.objective - 2.0).abs() < 1e-6,
        "t_f = {}",
        outcome.objective
    );
    assert!((outcome.trajectory.duration - outcome.objective).abs() < 1e-12);
}

/// min ½∫(x² + u²), ẋ = −x³ + u.
struct Hypersensitive {
    ends: [f64; 2],
    duration: f64,
}

impl Ocp for Hypersensitive {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        Formulation {
            states: states(&[("x", Interval::FREE)]),
            controls: vec![Quantity::new("u", Interval::FREE)],
            path: vec![],
            boundary: vec![],
            initial: fixed(&self.ends[..1]),
            terminal: fixed(&self.ends[1..]),
            duration: Interval::fixed(self.duration),
        }
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(
        &self,
        p: Point<'_, S>,
        _: &mut (),
        rates: &mut [S],
        _: &mut [S],
    ) -> S {
        let (x, u) = (p.x[0], p.u[0]);
        rates[0] = u - x * x * x;
        (x * x + u * u) * 0.5
    }
}

/// g(s) = ¼(s√(s²+1) + asinh s); J = g(x₀²) − x₀⁴/4 + g(x_f²) + x_f⁴/4.
fn hypersensitive_optimum([a, b]: [f64; 2]) -> f64 {
    let g = |s: f64| 0.25 * (s * (s * s + 1.0).sqrt() + s.asinh());
    g(a * a) - a.powi(4) / 4.0 + g(b * b) + b.powi(4) / 4.0
}

#[test]
fn hypersensitive_meets_its_closed_form() {
    let ends = [1.5, 1.0];
    let optimum = hypersensitive_optimum(ends);
    assert!((optimum - 1.330806905).abs() < 1e-9);
    let outcome = solve(
        &Hypersensitive {
            ends,
            duration: 50.0,
        },
        &refined(10, 5, 1e-7, 12),
    );
    assert!(
        (outcome.objective - optimum).abs() < 1e-8,
        "J = {}",
        outcome.objective
    );
}

#[test]
fn stiff_hypersensitive_meets_its_closed_form() {
    let ends = [1.0, 1.5];
    let optimum = hypersensitive_optimum(ends);
    assert!((optimum - 3.362056905).abs() < 1e-9);
    let outcome = solve(
        &Hypersensitive {
            ends,
            duration: 1e4,
        },
        &refined(10, 5, 1e-6, 25),
    );
    assert!(outcome.converged, "error {:e}", outcome.max_error());
    assert!(
        (outcome.objective - optimum).abs() < 1e-7,
        "J = {}",
        outcome.objective
    );
}

/// Fastest slide from rest to a point 2 m along and 2 m below; states x, y (down), speed.
struct Brachistochrone;

impl Ocp for Brachistochrone {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let free = Interval::FREE;
        Formulation {
            states: states(&[("along", free), ("down", free), ("speed", free)]),
            controls: vec![Quantity::new(
                "slope",
                Interval::new(0.0, std::f64::consts::FRAC_PI_2),
            )],
            path: vec![],
            boundary: vec![],
            initial: fixed(&[0.0; 3]),
            terminal: vec![Interval::fixed(2.0), Interval::fixed(2.0), free],
            duration: Interval::new(0.1, 10.0),
        }
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(
        &self,
        p: Point<'_, S>,
        _: &mut (),
        rates: &mut [S],
        _: &mut [S],
    ) -> S {
        let (s, c) = p.u[0].sin_cos();
        rates[0] = p.x[2] * c;
        rates[1] = p.x[2] * s;
        rates[2] = s * 9.81;
        S::zero()
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), _: &mut [S]) -> S {
        ends.duration
    }
}

#[test]
fn brachistochrone_meets_its_time() {
    let outcome = solve(&Brachistochrone, &refined(4, 6, 1e-7, 6));
    assert!(
        (outcome.objective - 0.8243386694).abs() < 1e-8,
        "t_f = {}",
        outcome.objective
    );
}
