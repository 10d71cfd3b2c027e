//! Problems in any units and with any bounds, by one call.

use crate::brachistochrone::Brachistochrone;
use crate::hypersensitive::Hypersensitive;
use crate::integrators::{Integrator, bryson_denham};
use crate::refined;
use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::ocp::{self, Ends, Formulation, Interval, Ocp, Point, Quantity};
use ffsm_ipopt::refine::Outcome;

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
            ..ends
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
