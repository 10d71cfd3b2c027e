//! Problems whose functions are not a number between the points of the mesh: never converged.

use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::nlp::{self, Control};
use ffsm_ipopt::ocp::{Formulation, Interval, Ocp, Point, Quantity};
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
