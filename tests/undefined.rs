//! Problems whose functions are not a number between the points of the mesh: never converged.

use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::nlp::{self, Control};
use ffsm_ipopt::ocp::{self, Formulation, Interval, Ocp, Point, Quantity, WayPoint};
use ffsm_ipopt::refine::{Method, Outcome, Refinement, Settings, Verdict};
use ffsm_ipopt::transcription::Patterns;

/// ẋ = u from 0 to 1 in 1 s at least ∫u², the optimum being u = 1. Between the times `gap` the rate
/// or the path row u ≤ 2 is NaN.
struct Gap {
    gap: [f64; 2],
    rate: bool,
    row: bool,
}

impl Ocp for Gap {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        Formulation {
            states: vec![Quantity::new("x", Interval::FREE)],
            controls: vec![Quantity::new("u", Interval::FREE)],
            path: vec![Quantity::new("row", Interval::new(-2.0, 2.0))],
            boundary: vec![],
            way_points: vec![],
            initial: vec![Interval::fixed(0.0)],
            terminal: vec![Interval::fixed(1.0)],
            duration: Interval::fixed(1.0),
            ..Formulation::default()
        }
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        _: &mut (),
        rates: &mut [S],
        path: &mut [S],
    ) -> S {
        let u = point.u[0];
        let t = point.t.value();
        let undefined = self.gap[0] < t && t < self.gap[1];
        let value = |gone: bool| if gone && undefined { u * f64::NAN } else { u };
        rates[0] = value(self.rate);
        path[0] = value(self.row);
        u * u
    }
}

fn solve(ocp: &Gap, settings: &Settings) -> Outcome {
    let refinement = Refinement {
        ocp,
        patterns: &Patterns::detect(ocp),
        settings,
        solver: &nlp::Settings::default(),
    };
    let start = refinement.straight_start().unwrap();
    refinement.run(&start, &mut |_| Control::Continue).unwrap()
}

/// Two segments of one point: points at 0 and 0.5, midpoints of (28) at 0.25 and 0.75, rows looked
/// at in quarters of the segments.
fn coarse(max_iterations: usize) -> Settings {
    Settings {
        segments: 2,
        points: 1,
        max_iterations: Some(max_iterations),
        ..Settings::default()
    }
}

#[test]
fn a_rate_that_is_not_a_number_is_no_small_error() {
    let ocp = Gap {
        gap: [0.6, 0.9],
        rate: true,
        row: false,
    };
    let outcome = solve(&ocp, &coarse(1));
    assert!(outcome.status.is_solved(), "{:?}", outcome.status);
    assert!((outcome.objective - 1.0).abs() < 1e-6);
    assert!(!outcome.converged);
    assert!(outcome.max_error().is_nan(), "{}", outcome.max_error());
    let record = outcome.records.last().unwrap();
    assert_eq!(record.verdict, Verdict::Undefined);
    assert!(record.verdict.to_string().contains("not a number"));
    assert!(record.segment_errors[0][0] < 1e-6 && record.segment_errors[1][0].is_nan());
    assert!(record.quadrature_error.is_nan());
    // With the gap nowhere the same is converged.
    let ocp = Gap {
        gap: [2.0, 3.0],
        ..ocp
    };
    let outcome = solve(&ocp, &coarse(1));
    assert!(outcome.converged && outcome.records[0].verdict == Verdict::Converged);
}

#[test]
fn a_path_row_that_is_not_a_number_is_within_no_bounds() {
    let ocp = Gap {
        gap: [0.6, 0.9],
        rate: false,
        row: true,
    };
    let outcome = solve(&ocp, &coarse(1));
    assert!(outcome.status.is_solved(), "{:?}", outcome.status);
    assert!(outcome.max_error() < 1e-6);
    assert!(!outcome.converged);
    let record = outcome.records.last().unwrap();
    assert_eq!(record.verdict, Verdict::Undefined);
    assert_eq!(record.max_violation, f64::INFINITY);
    let [violation] = outcome.violations[..] else {
        panic!("{:?}", outcome.violations)
    };
    assert!(violation.value.is_nan() && violation.excess == f64::INFINITY);
    assert!(violation.t > 0.6 && violation.t < 0.9, "{violation:?}");
}

#[test]
fn the_global_method_does_not_take_it_for_accurate_either() {
    let ocp = Gap {
        gap: [0.6, 0.62],
        rate: true,
        row: false,
    };
    let settings = Settings {
        method: Method::Global,
        global_points: 1,
        max_global_points: 1,
        ..Settings::default()
    };
    // The only midpoint is 0.5: nothing is seen of the gap, and with it there nothing is known.
    assert!(solve(&ocp, &settings).converged);
    let ocp = Gap {
        gap: [0.4, 0.6],
        ..ocp
    };
    let outcome = solve(&ocp, &settings);
    assert_eq!(outcome.records[0].verdict, Verdict::Undefined);
    assert!(!outcome.converged && outcome.max_error().is_nan());
}

#[test]
fn refinement_goes_on_where_nothing_is_known() {
    let ocp = Gap {
        gap: [0.6, 0.9],
        rate: true,
        row: false,
    };
    // A finer mesh has a point in the gap, where the solver meets it.
    let outcome = solve(&ocp, &coarse(4));
    assert!(!outcome.converged);
    let last = outcome.records.last().unwrap();
    assert_eq!(outcome.records.len(), 2);
    assert!(matches!(last.verdict, Verdict::NotSolved(_)), "{last:?}");
}

/// ẋ = v, v̇ = u, which forgets what it is told to.
struct Forgetful {
    formulation: Formulation,
    forgets: &'static str,
}

impl Forgetful {
    fn new(forgets: &'static str) -> Self {
        let [start, end] = [0.0, 1.0].map(Interval::fixed);
        let formulation = Formulation::over(Interval::fixed(1.0))
            .state(Quantity::new("place", Interval::FREE), start, end)
            .state(Quantity::new("speed", Interval::FREE), start, start)
            .control(Quantity::new("force", Interval::FREE))
            .path_row(Quantity::new("power", Interval::FREE));
        Self {
            formulation,
            forgets,
        }
    }
}

impl Ocp for Forgetful {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        self.formulation.clone()
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        _: &mut (),
        rates: &mut [S],
        path: &mut [S],
    ) -> S {
        let u = point.u[0];
        rates[0] = point.x[1];
        match self.forgets {
            "rate" => {}
            "sum" => rates[1] += u,
            _ => rates[1] = u,
        }
        match self.forgets {
            "row" => {}
            "root" => path[0] = (point.t - 0.5).sqrt(),
            _ => path[0] = u * point.x[1],
        }
        u.square()
    }
}

fn refused(problem: &Forgetful) -> String {
    let error = ocp::solve(problem, &ocp::Settings::default()).unwrap_err();
    error.to_string()
}

#[test]
fn what_is_never_written_is_named() {
    for (forgets, expected) in [
        ("rate", "rates[1] (speed) was never written"),
        ("sum", "rates[1] (speed) was never written"),
        ("row", "path[0] (power) was never written"),
        ("root", "path[0] (power) of Ocp::continuous is NaN at 0 s"),
    ] {
        let message = refused(&Forgetful::new(forgets));
        assert!(message.starts_with(expected), "{message}");
    }
    let outcome = ocp::solve(&Forgetful::new(""), &ocp::Settings::default()).unwrap();
    assert!(outcome.converged && (outcome.objective - 12.0).abs() < 1e-8);
}

#[test]
fn formulations_that_cannot_be_are_refused() {
    let change = |change: fn(&mut Formulation), expected: &str| {
        let mut problem = Forgetful::new("");
        change(&mut problem.formulation);
        let message = refused(&problem);
        assert!(message.contains(expected), "{message}");
    };
    change(
        |f| f.duration = Interval::fixed(-1.0),
        "duration is -1 to -1 s",
    );
    change(|f| f.duration = Interval::FREE, "duration is -inf to inf s");
    change(
        |f| f.duration = Interval::fixed(f64::NAN),
        "duration is NaN",
    );
    change(|f| f.states.clear(), "states is empty");
    change(
        |f| f.initial.truncate(1),
        "initial has 1 intervals: expected 2",
    );
    change(
        |f| f.terminal.push(Interval::FREE),
        "terminal has 3 intervals",
    );
    change(
        |f| f.controls[0].bounds = Interval::new(2.0, 1.0),
        "force allows no value, it is 2 to 1",
    );
    change(
        |f| f.states[0].bounds = Interval::new(0.0, 0.5),
        "place, at the end allows no value, it is 1 to 0.5",
    );
    change(
        |f| f.path[0] = f.path[0].clone().scaled(0.0),
        "the scale of power is 0",
    );
    let point = |fraction: f64, states: usize| WayPoint {
        fraction,
        states: vec![Interval::FREE; states],
        rows: vec![],
    };
    for (points, expected) in [
        (vec![point(1.0, 2)], "way-point 0 is at 1"),
        (vec![point(0.5, 2), point(0.5, 2)], "way-point 1 is at 0.5"),
        (vec![point(0.5, 1)], "states of way-point 0 has 1 intervals"),
    ] {
        let mut problem = Forgetful::new("");
        problem.formulation.way_points = points;
        let message = refused(&problem);
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn a_guess_is_taken_where_it_is_good_and_refused_where_it_is_no_time() {
    let settings = ocp::Settings::default();
    let problem = Forgetful::new("");
    let outcome = ocp::solve_from(&problem, &settings, 1.0, |fraction, x, u| {
        x[0] = fraction * fraction * (3.0 - 2.0 * fraction);
        x[1] = 6.0 * fraction * (1.0 - fraction);
        u[0] = 6.0 - 12.0 * fraction;
    });
    assert!((outcome.unwrap().objective - 12.0).abs() < 1e-8);
    for duration in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = ocp::solve_from(&problem, &settings, duration, |_, _, _| {});
        let message = refused.unwrap_err().to_string();
        assert!(
            message.contains("the duration of the start is"),
            "{message}"
        );
    }
}
