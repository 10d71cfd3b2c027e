//! Optimal control problems with closed-form answers, through the generic interface.

use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::nlp::{self, Control};
use ffsm_ipopt::ocp::{
    self, Ends, Formulation, InteriorPoint, Interval, Ocp, Point, Quantity, WayPoint,
};
use ffsm_ipopt::refine::{Bounded, Event, Method, Outcome, Record, Refinement, Settings, Verdict};
use ffsm_ipopt::transcription::Patterns;

/// Solves from the straight line and refines to the tolerance.
fn solve<O: Ocp>(ocp: &O, settings: &Settings) -> Outcome {
    settings.validate().unwrap();
    let mut solver = nlp::Settings::default();
    solver.max_iterations = 2000;
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
        max_iterations: Some(max_iterations),
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
    /// Fraction of the duration, bounds of the position and of the rate there.
    passed: Vec<(f64, [Interval; 2])>,
}

impl Ocp for Integrator {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        Formulation {
            states: states(&[("position", self.position), ("rate", Interval::FREE)]),
            controls: vec![Quantity::new("force", self.control)],
            path: vec![],
            boundary: vec![],
            way_points: self.passed.iter().map(integrator_passed).collect(),
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

    fn way_point<S: Scalar>(&self, point: InteriorPoint<'_, S>, _: &mut (), rows: &mut [S]) {
        rows[0] = point.x[0] * 2.0;
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), _: &mut [S]) -> S {
        ends.duration * self.time_weight
    }
}

/// The rate is bounded as a state, the position by a row of twice its value.
fn integrator_passed(&(fraction, [position, rate]): &(f64, [Interval; 2])) -> WayPoint {
    let twice = Interval::new(2.0 * position.lower, 2.0 * position.upper);
    WayPoint {
        fraction,
        states: vec![Interval::FREE, rate],
        rows: vec![Quantity::new("twice the position", twice)],
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
        passed: vec![],
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
fn bounds_exceeded_between_the_points_are_refined_away() {
    let limit = 0.1;
    // The error estimate is content with anything.
    let coarse = solve(&bryson_denham(limit), &refined(4, 3, 1e3, 1));
    let [found] = &coarse.violations[..] else {
        panic!("{:?}", coarse.violations);
    };
    assert_eq!(found.what, Bounded::State(0));
    assert!((found.value - limit - found.excess).abs() < 1e-15);
    assert!((found.relative - found.excess / limit).abs() < 1e-15);
    assert_eq!(coarse.records[0].max_violation, found.relative);
    let (mut x, mut u) = ([0.0; 2], [0.0]);
    coarse.trajectory.at_fraction(found.t, &mut x, &mut u);
    assert!((x[0] - found.value).abs() < 1e-12);

    let fine = solve(&bryson_denham(limit), &refined(4, 3, 1e3, 20));
    assert!(fine.violations.is_empty(), "{:?}", fine.violations);
    let highest = (0..=10_000).fold(0.0_f64, |highest, k| {
        let fraction = f64::from(k) / 10_000.0;
        fine.trajectory.at_fraction(fraction, &mut x, &mut u);
        highest.max(x[0])
    });
    assert!(highest < limit * (1.0 + 1.2e-3), "{highest}");
    // A node stands where the first mesh was outside the farthest.
    assert!(fine.records[1].breakpoints.contains(&found.t));
}

#[test]
fn a_mesh_for_the_sake_of_bounds_that_fails_is_put_aside_with_its_record() {
    let problem = bryson_denham(0.1);
    let settings = refined(4, 3, 1e3, 20);
    let full = solve(&problem, &settings);
    let converged = |record: &Record| record.verdict.is_converged();
    let count = full.records.iter().position(converged).unwrap() + 1;
    assert!(count < full.records.len());
    // The same, stopped on the mesh after the first that counts.
    let patterns = Patterns::detect(&problem);
    let refinement = Refinement {
        ocp: &problem,
        patterns: &patterns,
        settings: &settings,
        solver: &nlp::Settings::default(),
    };
    let start = refinement.straight_start().unwrap();
    let outcome = refinement.run(&start, &mut |event| match event {
        Event::Mesh { iteration, .. } if iteration > count => Control::Stop,
        _ => Control::Continue,
    });
    let outcome = outcome.unwrap();
    assert!(outcome.converged && outcome.status.is_solved());
    assert_eq!(outcome.records.len(), count);
    let last = outcome.records.last().unwrap();
    assert_eq!(last.points, outcome.trajectory.mesh.points());
    assert_eq!(last.objective, outcome.objective);
    let [aside] = &outcome.discarded[..] else {
        panic!("{:?}", outcome.discarded)
    };
    let interrupted = Verdict::NotSolved(nlp::Status::Interrupted);
    assert_eq!(aside.verdict, interrupted);
    assert!(aside.points > last.points);
    // Its iterations are among those of all solves.
    let all = outcome.records.iter().chain(&outcome.discarded);
    let iterations: u32 = all.map(|record| record.nlp_iterations).sum();
    assert_eq!(outcome.statistics.iterations, iterations);
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
        passed: vec![],
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
        passed: vec![],
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
            way_points: vec![],
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
            way_points: vec![],
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

/// ∫u² of the cubic from (x₀, v₀) to (x₁, v₁) in `t`.
fn cubic_effort(t: f64, [x0, v0]: [f64; 2], [x1, v1]: [f64; 2]) -> f64 {
    let d = x1 - x0;
    12.0 * d * d / t.powi(3) - 12.0 * d * (v0 + v1) / (t * t)
        + 4.0 * (v0 * v0 + v0 * v1 + v1 * v1) / t
}

#[test]
fn double_integrator_through_way_points_is_a_cubic_spline() {
    // From rest at 0 to rest at 1 in 2 s, through 0.9 at a third and 0.2, at the rate 0.4, at 0.7
    // of it: the rate at the first is free, so that the spline is smooth there.
    let (t, at) = (2.0, [1.0 / 3.0, 0.7]);
    let effort = |v: f64| {
        let (a, b) = ([0.9, v], [0.2, 0.4]);
        cubic_effort(at[0] * t, [0.0, 0.0], a)
            + cubic_effort((at[1] - at[0]) * t, a, b)
            + cubic_effort((1.0 - at[1]) * t, b, [1.0, 0.0])
    };
    // A parabola in v.
    let (low, mid, high) = (effort(-1.0), effort(0.0), effort(1.0));
    let v = 0.5 * (low - high) / (low - 2.0 * mid + high);
    let optimum = effort(v);
    let mut problem = Integrator {
        initial: [0.0, 0.0],
        terminal: [1.0, 0.0],
        position: Interval::FREE,
        weight: 1.0,
        control: Interval::FREE,
        duration: Interval::fixed(t),
        time_weight: 0.0,
        passed: vec![
            (at[0], [Interval::fixed(0.9), Interval::FREE]),
            (at[1], [Interval::fixed(0.2), Interval::fixed(0.4)]),
        ],
    };
    // Cubics in two segments, one of which the way-points cut in three.
    let outcome = solve(&problem, &refined(2, 4, 1e-10, 1));
    let gap = outcome.objective - optimum;
    assert!(
        gap.abs() < 1e-9 * optimum,
        "J = {}, {optimum}",
        outcome.objective
    );
    assert!(outcome.max_error() < 1e-9);
    let mesh = &outcome.trajectory.mesh;
    let node = mesh.node_at(at[0]).expect("a breakpoint at the way-point");
    let state = outcome.trajectory.state(node);
    assert!(
        (state[0] - 0.9).abs() < 1e-9 && (state[1] - v).abs() < 1e-9,
        "{state:?}"
    );
    // One polynomial a leg does as well.
    let global = Settings {
        method: Method::Global,
        global_points: 4,
        ..Settings::default()
    };
    let outcome = solve(&problem, &global);
    assert_eq!(outcome.trajectory.mesh.segments(), 3);
    assert!((outcome.objective - optimum).abs() < 1e-9 * optimum);
    // Without the way-points the effort is that of one cubic.
    problem.passed.clear();
    let outcome = solve(&problem, &refined(2, 4, 1e-10, 1));
    assert!((outcome.objective - cubic_effort(t, [0.0, 0.0], [1.0, 0.0])).abs() < 1e-9);
}

#[test]
fn bryson_denham_with_one_contact_needs_its_limit_there_only() {
    // For 1/6 ≤ L ≤ 1/4 the path touches L at half time, J = 2 + 6(1 − 4L)²: the same as with the
    // limit at that instant alone.
    let limit = 0.2;
    let mut problem = bryson_denham(f64::INFINITY);
    problem.passed = vec![(
        0.5,
        [Interval::new(f64::NEG_INFINITY, limit), Interval::FREE],
    )];
    let outcome = solve(&problem, &refined(3, 4, 1e-10, 1));
    let optimum = 2.0 + 6.0 * (1.0 - 4.0 * limit).powi(2);
    assert!(
        (outcome.objective - optimum).abs() < 1e-7,
        "J = {}",
        outcome.objective
    );
    // Without the limit: J = 2.
    let free = solve(&bryson_denham(f64::INFINITY), &refined(3, 4, 1e-10, 1));
    assert!((free.objective - 2.0).abs() < 1e-9);
}

#[test]
fn the_fastest_way_with_a_stop_at_half_time_is_two_fastest_ways() {
    let free = Interval::FREE;
    let problem = Integrator {
        initial: [0.0, 0.0],
        terminal: [1.0, 0.0],
        position: free,
        weight: 0.0,
        control: Interval::symmetric(1.0),
        duration: Interval::new(0.5, 10.0),
        time_weight: 1.0,
        passed: vec![(0.5, [free, Interval::fixed(0.0)])],
    };
    // Rest to rest over 1/2 takes 2√(1/2), twice. Four segments have breakpoints at the switches.
    let outcome = solve(&problem, &refined(4, 4, 1e-9, 1));
    let optimum = 2.0 * 2f64.sqrt();
    assert!(
        (outcome.objective - optimum).abs() < 1e-7,
        "t_f = {}",
        outcome.objective
    );
}

#[test]
fn way_points_keep_their_breakpoints_and_multipliers_from_mesh_to_mesh() {
    /// Hypersensitive, through 1 at 0.37 of the duration.
    struct Through(Hypersensitive);
    impl Ocp for Through {
        type Scratch<S: Scalar> = ();
        fn formulation(&self) -> Formulation {
            let through = WayPoint {
                fraction: 0.37,
                states: vec![Interval::fixed(1.0)],
                rows: vec![],
            };
            Formulation {
                way_points: vec![through],
                ..self.0.formulation()
            }
        }
        fn scratch<S: Scalar>(&self) {}
        fn continuous<S: Scalar>(
            &self,
            p: Point<'_, S>,
            scratch: &mut (),
            rates: &mut [S],
            path: &mut [S],
        ) -> S {
            self.0.continuous(p, scratch, rates, path)
        }
    }
    let ends = [1.5, 1.0];
    let duration = 100.0;
    let outcome = solve(
        &Through(Hypersensitive { ends, duration }),
        &refined(10, 5, 1e-7, 12),
    );
    // Both legs are long: the optimum is that of two problems that meet at 1.
    let optimum = hypersensitive_optimum([1.5, 1.0]) + hypersensitive_optimum([1.0, 1.0]);
    assert!(
        (outcome.objective - optimum).abs() < 1e-8,
        "J = {}",
        outcome.objective
    );
    assert!(outcome.records.len() > 2);
    for record in &outcome.records {
        assert!(record.breakpoints.contains(&0.37));
    }
    let last = outcome.records.last().unwrap();
    assert!(last.nlp_iterations <= 8, "{}", last.nlp_iterations);
}

/// Solves by one call, as people do.
fn solved<O: Ocp>(problem: &O, max_iterations: usize) -> Outcome {
    let mut settings = ocp::Settings::default();
    settings.mesh.max_iterations = Some(max_iterations);
    let outcome = ocp::solve(problem, &settings).unwrap();
    assert!(
        outcome.converged,
        "{:?}",
        outcome.records.last().unwrap().verdict
    );
    outcome
}

fn assert_relative(found: f64, expected: f64, tolerance: f64) {
    let gap = (found / expected - 1.0).abs();
    assert!(gap < tolerance, "{found} instead of {expected}");
}

/// A cart against a gust: ẋ = u − 5 exp(−2(t − 15)²), x from 0 to 50, at least 9T + ∫u².
///
/// `hidden`: the gust is behind a branch that no recording away from it sees.
struct Gust {
    hidden: bool,
    duration: Interval,
}

impl Ocp for Gust {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        Formulation::over(self.duration)
            .state(
                Quantity::new("x", Interval::FREE),
                Interval::fixed(0.0),
                Interval::fixed(50.0),
            )
            .control(Quantity::new("u", Interval::FREE))
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(
        &self,
        p: Point<'_, S>,
        _: &mut (),
        rates: &mut [S],
        _: &mut [S],
    ) -> S {
        rates[0] = p.u[0];
        if !self.hidden || (p.t.value() - 15.0).abs() < 5.0 {
            rates[0] -= ((p.t - 15.0).square() * -2.0).exp() * 5.0;
        }
        p.u[0].square()
    }

    fn boundary<S: Scalar>(&self, ends: Ends<'_, S>, _: &mut (), _: &mut [S]) -> S {
        ends.duration * 9.0
    }
}

#[test]
fn derivatives_that_underflow_or_hide_behind_a_branch_are_there() {
    for (hidden, upper) in [(false, 400.0), (true, 400.0)] {
        let duration = Interval::new(1.0, upper);
        let outcome = solved(&Gust { hidden, duration }, 15);
        assert_relative(outcome.objective, 305.5648, 1e-6);
    }
}

/// A problem with its states in other units and time and cost as they are.
struct InUnits<O> {
    inner: O,
    units: Vec<f64>,
}

struct InUnitsScratch<S, I> {
    inner: I,
    x: Vec<S>,
    ends: [Vec<S>; 2],
}

impl<O: Ocp> Ocp for InUnits<O> {
    type Scratch<S: Scalar> = InUnitsScratch<S, O::Scratch<S>>;

    fn formulation(&self) -> Formulation {
        let mut formulation = self.inner.formulation();
        let scaled = |b: &Interval, unit: f64| Interval::new(b.lower / unit, b.upper / unit);
        for (i, &unit) in self.units.iter().enumerate() {
            let state = &mut formulation.states[i];
            state.bounds = scaled(&state.bounds, unit);
            formulation.initial[i] = scaled(&formulation.initial[i], unit);
            formulation.terminal[i] = scaled(&formulation.terminal[i], unit);
        }
        formulation
    }

    fn scratch<S: Scalar>(&self) -> Self::Scratch<S> {
        let zeros = || vec![S::zero(); self.units.len()];
        InUnitsScratch {
            inner: self.inner.scratch(),
            x: zeros(),
            ends: [zeros(), zeros()],
        }
    }

    fn continuous<S: Scalar>(
        &self,
        p: Point<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rates: &mut [S],
        path: &mut [S],
    ) -> S {
        for (i, &unit) in self.units.iter().enumerate() {
            scratch.x[i] = p.x[i] * unit;
        }
        let inner = Point { x: &scratch.x, ..p };
        let cost = self
            .inner
            .continuous(inner, &mut scratch.inner, rates, path);
        for (rate, &unit) in rates.iter_mut().zip(&self.units) {
            *rate /= unit;
        }
        cost
    }

    fn boundary<S: Scalar>(
        &self,
        ends: Ends<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) -> S {
        for (i, &unit) in self.units.iter().enumerate() {
            scratch.ends[0][i] = ends.initial[i] * unit;
            scratch.ends[1][i] = ends.terminal[i] * unit;
        }
        let inner = Ends {
            initial: &scratch.ends[0],
            terminal: &scratch.ends[1],
            duration: ends.duration,
        };
        self.inner.boundary(inner, &mut scratch.inner, rows)
    }
}

/// J and points in `units` of the states, against those as stated.
fn assert_unit_free<O: Ocp>(
    make: impl Fn() -> O,
    states: usize,
    (optimum, tolerance): (f64, f64),
    units: &[f64],
) {
    let points = |outcome: &Outcome| outcome.trajectory.mesh.points();
    let plain = solved(&make(), 20);
    assert_relative(plain.objective, optimum, tolerance);
    for &unit in units {
        let inner = make();
        let units = vec![unit; states];
        let outcome = solved(&InUnits { inner, units }, 20);
        assert_relative(outcome.objective, optimum, tolerance);
        let found = (points(&outcome), points(&plain));
        assert!(
            found.0 <= 2 * found.1 && found.1 <= 2 * found.0,
            "{unit}: {found:?}"
        );
    }
}

#[test]
fn the_units_of_the_states_play_no_part() {
    assert_unit_free(
        || bryson_denham(0.1),
        2,
        (4.444444, 2e-6),
        &[1e-6, 0.02, 50.0, 1e7],
    );
    assert_unit_free(
        || Brachistochrone,
        3,
        (0.8243386694, 1e-7),
        &[1e-6, 0.02, 50.0],
    );
    let hypersensitive = || Hypersensitive {
        ends: [1.5, 1.0],
        duration: 50.0,
    };
    assert_unit_free(hypersensitive, 1, (1.330806905, 1e-6), &[0.02, 50.0]);
}

#[test]
fn a_bound_far_away_has_no_effect_to_the_digit() {
    let within = |bound: f64| {
        let mut problem = bryson_denham(0.1);
        problem.control = Interval::symmetric(bound);
        let outcome = solved(&problem, 12);
        (outcome.objective, outcome.trajectory.mesh.points())
    };
    let free = within(f64::INFINITY);
    for bound in [1e6, 1e8, 9.99e8, 1e12, 1e300] {
        assert_eq!(within(bound), free, "{bound}");
    }
}

#[test]
fn a_bound_that_seemed_far_and_acts_is_kept() {
    // From 0 to 1 in the least time: the more thrust the less time, T = 2/√u.
    let problem = Integrator {
        initial: [0.0, 0.0],
        terminal: [1.0, 0.0],
        position: Interval::FREE,
        weight: 0.0,
        control: Interval::symmetric(1e6),
        duration: Interval::new(1e-4, 0.1),
        time_weight: 1.0,
        passed: vec![],
    };
    let mut settings = ocp::Settings::from(refined(2, 4, 1e-7, 3));
    settings.solver.max_iterations = 2000;
    let outcome = ocp::solve(&problem, &settings).unwrap();
    assert_relative(outcome.objective, 2e-3, 1e-4);
    let most = outcome
        .trajectory
        .u
        .iter()
        .fold(0.0_f64, |m, u| m.max(u.abs()));
    assert!(most < 1e6 * (1.0 + 1e-6), "{most}");
}
